// In one file: it alone knows Boost, which takes long to compile.
#include "tools/console/server.h"

#include <fmt/format.h>
#include <sodium.h>
#include <boost/asio/bind_executor.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/host_name.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <deque>
#include <list>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <thread>

#include "graph/text/errors.h"
#include "tools/console/history.h"
#include "tools/console/page.h"
#include "tools/console/unseen.h"

namespace jarol::tools::console {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using tcp = asio::ip::tcp;
using Error = beast::error_code;
using Request = http::request<http::empty_body>;
using namespace std::chrono_literals;

// A page that is slow, and goes on, gets what there was until then.
constexpr auto longest_end = 5s;

// Pages show what is new so often.
constexpr auto frame = 33ms;

std::string make_token() {
  if (sodium_init() < 0) throw Unfinished("no random numbers for the console's token can be had");
  unsigned char bytes[16];
  randombytes_buf(bytes, sizeof bytes);
  std::string text;
  for (const unsigned char byte : bytes) text += fmt::format("{:02x}", byte);
  return text;
}

// Of "/socket?token=abc" the value, or nothing.
std::string_view token_of(std::string_view target) {
  constexpr std::string_view key = "token=";
  for (std::size_t at = target.find('?'); at != std::string_view::npos; at = target.find('&', at)) {
    ++at;
    if (target.substr(at).starts_with(key)) return target.substr(at, target.find('&', at) - at).substr(key.size());
  }
  return {};
}

std::string_view path_of(std::string_view target) { return target.substr(0, target.find('?')); }

std::string_view text_of(beast::string_view text) { return {text.data(), text.size()}; }

// The page that asks was served from here: a browser says from where it has it, other programs say nothing.
bool is_own_origin(const Request& request) {
  if (request.count(http::field::origin) == 0) return true;
  const std::string_view origin = text_of(request[http::field::origin]), host = text_of(request[http::field::host]);
  return origin == fmt::format("http://{}", host) || origin == fmt::format("https://{}", host);
}

// Nobody can open 0.0.0.0: of all addresses of the machine its name stands for those that others know.
std::string host_text(const asio::ip::address& address) {
  if (address.is_unspecified()) {
    Error none;
    const std::string name = asio::ip::host_name(none);
    if (!none && !name.empty()) return name;
  }
  return address.is_v6() ? "[" + address.to_string() + "]" : address.to_string();
}

template <class Body>
void set_headers(http::response<Body>& response) {
  response.set(http::field::server, "jarol");
  response.set("X-Content-Type-Options", "nosniff");
  response.set("Referrer-Policy", "no-referrer");
  response.set("Cross-Origin-Resource-Policy", "same-origin");
  response.set(
      "Content-Security-Policy",
      "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src 'self'; "
      "base-uri 'none'; form-action 'none'; frame-ancestors 'none'");
}

http::response<http::string_body> plain(const Request& request, http::status status, const std::string& text) {
  http::response<http::string_body> response{status, request.version()};
  set_headers(response);
  response.set(http::field::content_type, "text/plain; charset=utf-8");
  response.keep_alive(false);
  response.body() = text + "\n";
  response.prepare_payload();
  return response;
}

http::response<http::string_body> answer_to(const Request& request) {
  if (request.method() != http::verb::get && request.method() != http::verb::head) {
    auto response = plain(request, http::status::method_not_allowed, "here is only what can be read");
    response.set(http::field::allow, "GET, HEAD");
    return response;
  }
  const PageFile* const file = find_page_file(path_of(text_of(request.target())));
  if (file == nullptr) return plain(request, http::status::not_found, "there is no such file; the page is at /");
  const bool known = text_of(request[http::field::if_none_match]) == file->etag;
  http::response<http::string_body> response{known ? http::status::not_modified : http::status::ok, request.version()};
  set_headers(response);
  response.set(http::field::etag, beast::string_view(file->etag.data(), file->etag.size()));
  response.set(http::field::cache_control, "no-cache");
  response.set(http::field::content_type, beast::string_view(file->type.data(), file->type.size()));
  if (file->is_gzip) response.set(http::field::content_encoding, "gzip");
  response.keep_alive(request.keep_alive());
  if (!known) response.body() = file->bytes;
  response.prepare_payload();
  if (request.method() == http::verb::head) response.body().clear();
  return response;
}

// So many a second, and no more at once.
class Allowance {
 public:
  bool take() {
    const auto now = std::chrono::steady_clock::now();
    left_ = std::min<double>(Server::max_messages_a_second, left_ + std::chrono::duration<double>(now - last_).count() *
                                                                        Server::max_messages_a_second);
    last_ = now;
    if (left_ < 1) return false;
    left_ -= 1;
    return true;
  }

 private:
  double left_ = Server::max_messages_a_second;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace

class Server::Implementation {
 public:
  Implementation(const ServerOptions& options, std::string hello, NextMessages next, Answer answer, Left left);
  ~Implementation();

  const std::string& url() const { return url_; }
  void send(std::uint64_t page, std::string message);

 private:
  class Connection;
  class Watcher;

  void accept();
  void show_next();
  void end();
  void wait_for_end();

  const std::string token_ = make_token();
  const std::size_t max_message_, max_answers_;
  const std::shared_ptr<const std::string> hello_;
  const NextMessages next_;
  const Answer answer_;
  const Left left_;
  std::uint64_t pages_ = 0;  // so far
  const bool replays_;
  History history_;
  std::size_t connections_ = 0;  // watchers among them
  // that have not shown the token, the oldest first
  std::list<Connection*> strangers_;
  asio::io_context context_{1};  // what waits in it knows what stands above
  tcp::acceptor acceptor_{context_};
  asio::steady_timer timer_{context_}, end_timer_{context_};
  std::set<std::shared_ptr<Watcher>> watchers_;
  bool ending_ = false;
  std::chrono::steady_clock::time_point latest_end_{};
  std::string url_;
  std::thread thread_;
};

/// A page on its socket.
class Server::Implementation::Watcher : public std::enable_shared_from_this<Watcher> {
 public:
  Watcher(Implementation& server, beast::tcp_stream stream)
      : server_(server), page_(++server.pages_), socket_(std::move(stream)) {
    ++server_.connections_;
  }
  ~Watcher() { --server_.connections_; }

  void begin(const Request& request) {
    websocket::stream_base::timeout timeout{};
    timeout.handshake_timeout = 10s;
    timeout.idle_timeout = 20s;
    timeout.keep_alive_pings = true;
    socket_.set_option(timeout);
    socket_.read_message_max(server_.max_message_);
    socket_.async_accept(request, [self = shared_from_this()](Error error) {
      if (error || self->server_.ending_) return;
      const History& history = self->server_.history_;
      self->place_ = self->server_.replays_ ? history.begin() : history.end();
      self->server_.watchers_.insert(self);
      self->read();
      self->add_own(self->server_.hello_);
      self->write();
    });
  }

  std::uint64_t page() const { return page_; }

  /// For this page alone.
  void send(std::string message) {
    if (closing_) return;
    if (own_bytes_ + message.size() > server_.max_answers_) return refuse("does not take its answers");
    add_own(std::make_shared<const std::string>(std::move(message)));
    write();
  }

  /// Something new is there.
  void write() {
    if (writing_ || closing_) return;
    const auto now = std::chrono::steady_clock::now();
    const bool is_late = !unseen_.has_room(now);
    // a run that ends ends with its report
    if (is_late && !server_.ending_) return;
    now_ = next(now, is_late);
    if (!now_.text) {
      if (server_.ending_ && unseen_.is_all_seen()) close(websocket::close_code::going_away);
      return;
    }
    unseen_.send(now_.of, now);
    writing_ = true;
    socket_.text(true);
    socket_.async_write(asio::buffer(*now_.text), [self = shared_from_this()](Error error, std::size_t) {
      self->writing_ = false;
      if (error) return self->leave();
      self->write();
    });
  }

 private:
  History::Message next(History::Time now, bool only_last_few) {
    if (!own_.empty()) {
      History::Message message = std::move(own_.front());
      own_.pop_front();
      own_bytes_ -= message.text->size();
      return message;
    }
    if (after_missed_.text) return std::exchange(after_missed_, {});
    History::Message message = server_.history_.next(place_, only_last_few);
    if (place_.missed == 0) return message;
    after_missed_ = std::move(message);
    const nlohmann::json missed{{"missed", std::exchange(place_.missed, 0)}};
    return {std::make_shared<const std::string>(missed.dump()), now};
  }

  // Of what time that message is; null: there is none.
  const History::Time* next_time() const {
    if (!own_.empty()) return &own_.front().of;
    return after_missed_.text ? &after_missed_.of : server_.history_.next_time(place_);
  }

  void read() {
    socket_.async_read(read_, [self = shared_from_this()](Error error, std::size_t) {
      if (error) return self->leave();
      self->take(beast::buffers_to_string(self->read_.data()));
      self->read_.consume(self->read_.size());
      if (!self->closing_) self->read();
    });
  }

  void take(const std::string& message) {
    std::string answer;
    if (!socket_.got_text()) return refuse("expected text, got bytes");
    if (!allowance_.take()) return refuse(fmt::format("sent more than {} messages a second", max_messages_a_second));
    try {
      if (const auto seen = read_seen(message)) {
        unseen_.see(*seen);
        if (server_.ending_) server_.wait_for_end();
        return write();
      }
      answer = server_.answer_({page_, unseen_.behind(std::chrono::steady_clock::now(), next_time())}, message);
    } catch (const InputError& wrong) {
      answer = nlohmann::json{{"error", wrong.what()}}.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
    }
    if (!answer.empty()) send(std::move(answer));
  }

  void add_own(History::Text text) {
    own_bytes_ += text->size();
    own_.push_back({std::move(text), std::chrono::steady_clock::now()});
  }

  void refuse(const std::string& why) { close({websocket::close_code::policy_error, why}); }

  void close(const websocket::close_reason& reason) {
    if (std::exchange(closing_, true)) return;
    socket_.async_close(reason, [self = shared_from_this()](Error) { self->leave(); });
  }

  void leave() {
    closing_ = true;
    if (server_.left_ && !std::exchange(has_left_, true)) server_.left_(page_);
    beast::get_lowest_layer(socket_).close();
    server_.watchers_.erase(shared_from_this());
    if (server_.ending_ && server_.watchers_.empty()) server_.context_.stop();
  }

  Implementation& server_;
  const std::uint64_t page_;
  websocket::stream<beast::tcp_stream> socket_;
  beast::flat_buffer read_;
  Allowance allowance_;
  History::Place place_;
  std::deque<History::Message> own_;  // before what all get
  std::size_t own_bytes_ = 0;
  History::Message after_missed_;  // taken, behind the notice of what it has missed
  History::Message now_;           // is written
  Unseen unseen_;
  bool writing_ = false, closing_ = false, has_left_ = false;
};

/// A browser that asks for files, one after the other.
class Server::Implementation::Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(Implementation& server, tcp::socket socket) : server_(server), stream_(std::move(socket)) {
    ++server_.connections_;
    server_.strangers_.push_back(this);
  }
  ~Connection() { free_place(); }

  void read() {
    parser_.emplace();
    parser_->header_limit(8 << 10);
    parser_->body_limit(0);
    stream_.expires_after(10s);
    http::async_read(stream_, buffer_, *parser_, [self = shared_from_this()](Error error, std::size_t) {
      if (error == http::error::header_limit || error == http::error::body_limit)
        return self->send(plain({}, http::status::payload_too_large, "that is too long"));
      if (!error) self->serve(self->parser_->release());
    });
  }

  void refuse() {
    free_place();
    send(plain({}, http::status::service_unavailable, "too many watch; try again later"));
  }

  /// For one that is newer.
  void give_way() {
    free_place();
    stream_.close();
  }

 private:
  void free_place() {
    server_.strangers_.remove(this);
    if (std::exchange(has_place_, false)) --server_.connections_;
  }

  void serve(const Request& request) {
    if (server_.ending_) return;
    const std::string_view target = text_of(request.target()), token = token_of(target);
    const bool knows_token =
        token.size() == server_.token_.size() && sodium_memcmp(token.data(), server_.token_.data(), token.size()) == 0;
    if (knows_token) server_.strangers_.remove(this);
    if (path_of(target) != "/socket") return send(answer_to(request));
    if (!websocket::is_upgrade(request))
      return send(plain(request, http::status::upgrade_required, "here is a WebSocket"));
    if (!knows_token)
      return send(plain(request, http::status::forbidden,
                        "the token is missing or wrong; open the URL that jarol has printed"));
    if (!is_own_origin(request))
      return send(plain(request, http::status::forbidden, "this page was not served from here"));
    stream_.expires_never();
    std::make_shared<Watcher>(server_, std::move(stream_))->begin(request);
  }

  void send(http::response<http::string_body> response) {
    response_ = std::move(response);
    stream_.expires_after(10s);
    http::async_write(stream_, response_, [self = shared_from_this()](Error error, std::size_t) {
      if (error) return;
      if (self->response_.keep_alive()) return self->read();
      Error ignored;
      self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    });
  }

  Implementation& server_;
  bool has_place_ = true;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_{16 << 10};
  std::optional<http::request_parser<http::empty_body>> parser_;
  http::response<http::string_body> response_;
};

Server::Implementation::Implementation(const ServerOptions& options, std::string hello, NextMessages next,
                                       Answer answer, Left left)
    : max_message_(options.max_message),
      max_answers_(options.max_answers),
      hello_(std::make_shared<const std::string>(std::move(hello))),
      next_(std::move(next)),
      answer_(std::move(answer)),
      left_(std::move(left)),
      replays_(options.replays),
      history_(max_history, options.skips) {
  Error error;
  const asio::ip::address address = asio::ip::make_address(options.listen, error);
  if (error)
    throw InputError("the console can't listen on '" + options.listen +
                     "', which is no address; write it as in 127.0.0.1 or 0.0.0.0");
  const tcp::endpoint end(address, static_cast<unsigned short>(options.port));
  const auto require = [&](const Error& wrong) {
    if (wrong)
      throw InputError(
          fmt::format("the console can't listen on {} port {}: {}", options.listen, options.port, wrong.message()));
  };
  require(acceptor_.open(end.protocol(), error));
  require(acceptor_.set_option(asio::socket_base::reuse_address(true), error));
  require(acceptor_.bind(end, error));
  require(acceptor_.listen(asio::socket_base::max_listen_connections, error));
  const tcp::endpoint bound = acceptor_.local_endpoint();
  url_ = fmt::format("http://{}:{}{}?token={}", host_text(bound.address()), bound.port(), options.page, token_);
  accept();
  show_next();
  thread_ = std::thread([this] { context_.run(); });
}

Server::Implementation::~Implementation() {
  asio::post(context_, [this] { end(); });
  thread_.join();
}

void Server::Implementation::accept() {
  acceptor_.async_accept([this](Error error, tcp::socket socket) {
    if (ending_) return;
    if (!error) {
      const auto connection = std::make_shared<Connection>(*this, std::move(socket));
      // who does not show the token keeps nobody out who may
      if (connections_ > max_clients && strangers_.front() != connection.get()) strangers_.front()->give_way();
      connections_ > max_clients ? connection->refuse() : connection->read();
    } else if (error != asio::error::connection_aborted) {
      // as where there are no more descriptors: some may be free in a moment
      end_timer_.expires_after(100ms);
      return end_timer_.async_wait([this](Error) {
        if (!ending_) accept();
      });
    }
    accept();
  });
}

void Server::Implementation::show_next() {
  for (std::string& message : next_()) history_.add(std::move(message), std::chrono::steady_clock::now());
  // those who leave meanwhile are taken out
  for (const auto& watcher : std::vector(watchers_.begin(), watchers_.end())) watcher->write();
  if (ending_) return;
  timer_.expires_after(frame);
  timer_.async_wait([this](Error error) {
    if (!error && !ending_) show_next();
  });
}

void Server::Implementation::send(std::uint64_t page, std::string message) {
  asio::post(context_, [this, page, message = std::move(message)]() mutable {
    for (const auto& watcher : watchers_)
      if (watcher->page() == page) return watcher->send(std::move(message));
  });
}

void Server::Implementation::end() {
  ending_ = true;
  Error ignored;
  acceptor_.close(ignored);
  timer_.cancel();
  show_next();
  latest_end_ = std::chrono::steady_clock::now() + longest_end;
  wait_for_end();
  // nothing to wait for: no page is there
  if (watchers_.empty()) context_.stop();
}

// For a second; and again for one where a page goes on seeing what it is sent.
void Server::Implementation::wait_for_end() {
  end_timer_.expires_at(std::min(std::chrono::steady_clock::now() + 1s, latest_end_));
  end_timer_.async_wait([this](Error error) {
    if (error != asio::error::operation_aborted) context_.stop();
  });
}

Server::Server(const ServerOptions& options, std::string hello, NextMessages next, Answer answer, Left left)
    : implementation_(std::make_unique<Implementation>(options, std::move(hello), std::move(next), std::move(answer),
                                                       std::move(left))) {}
Server::~Server() = default;
const std::string& Server::url() const { return implementation_->url(); }
void Server::send(std::uint64_t page, std::string message) { implementation_->send(page, std::move(message)); }

}  // namespace jarol::tools::console

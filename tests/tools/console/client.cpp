#include "tests/tools/console/client.h"

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <stdexcept>

namespace jarol::tests {
namespace {
namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using tcp = asio::ip::tcp;
}  // namespace

Place::Place(const std::string& url) {
  const std::size_t begin = url.find("//") + 2, slash = url.find('/', begin), colon = url.rfind(':', slash);
  host = url.substr(begin, colon - begin);
  port = url.substr(colon + 1, slash - colon - 1);
  target = url.substr(slash);
}

HttpAnswer ask(const Place& place, const std::string& bytes) {
  asio::io_context context;
  tcp::socket socket(context);
  asio::connect(socket, tcp::resolver(context).resolve(place.host, place.port));
  beast::error_code error;
  asio::write(socket, asio::buffer(bytes), error);  // it may be refused before all of it is there
  beast::flat_buffer buffer;
  http::response_parser<http::string_body> parser;
  parser.body_limit(std::uint64_t{64} << 20);
  if (bytes.starts_with("HEAD")) parser.skip(true);
  http::read(socket, buffer, parser, error);
  if (error) return {};
  HttpAnswer answer{.status = static_cast<int>(parser.get().result_int()), .body = parser.get().body()};
  for (const auto& field : parser.get()) {
    std::string name(field.name_string());
    for (char& c : name) c = static_cast<char>(std::tolower(c));
    answer.headers[name] = std::string(field.value());
  }
  return answer;
}

HttpAnswer get(const Place& place, const std::string& target, const std::string& headers) {
  return ask(place,
             "GET " + target + " HTTP/1.1\r\nHost: " + place.host + ":" + place.port + "\r\n" + headers + "\r\n");
}

struct SilentConnection::Socket {
  asio::io_context context;
  tcp::socket plain{context};
};

SilentConnection::SilentConnection(const Place& place) : socket_(std::make_unique<Socket>()) {
  asio::connect(socket_->plain, tcp::resolver(socket_->context).resolve(place.host, place.port));
}
SilentConnection::~SilentConnection() = default;
SilentConnection::SilentConnection(SilentConnection&&) noexcept = default;

void SilentConnection::wait_for_end() {
  char byte = 0;
  beast::error_code error;
  asio::read(socket_->plain, asio::buffer(&byte, 1), error);
}

struct PageSocket::Socket {
  asio::io_context context;
  websocket::stream<tcp::socket> stream{context};
};

PageSocket::PageSocket(const std::string& url, const std::string& origin, int receive_room)
    : socket_(std::make_unique<Socket>()) {
  const Place place(url);
  auto& stream = socket_->stream;
  const auto ends = tcp::resolver(socket_->context).resolve(place.host, place.port);
  tcp::socket& plain = stream.next_layer();
  plain.open(tcp::v4());
  if (receive_room > 0) plain.set_option(asio::socket_base::receive_buffer_size(receive_room));
  plain.connect(ends.begin()->endpoint());
  stream.read_message_max(std::size_t{64} << 20);
  stream.set_option(websocket::stream_base::decorator([&](websocket::request_type& request) {
    if (!origin.empty()) request.set(http::field::origin, origin);
  }));
  websocket::response_type response;
  beast::error_code error;
  stream.handshake(response, place.host + ":" + place.port, place.socket_target(), error);
  if (error) throw std::runtime_error("the console refuses the socket: " + error.message());
}

PageSocket::~PageSocket() = default;
PageSocket::PageSocket(PageSocket&&) noexcept = default;

void PageSocket::send(const std::string& text) {
  beast::error_code error;  // the other side may have closed
  socket_->stream.text(true);
  socket_->stream.write(asio::buffer(text), error);
}

void PageSocket::send_bytes(const std::string& bytes) {
  beast::error_code error;
  socket_->stream.binary(true);
  socket_->stream.write(asio::buffer(bytes), error);
}

std::optional<nlohmann::json> PageSocket::read() {
  beast::flat_buffer buffer;
  beast::error_code error;
  socket_->stream.read(buffer, error);
  if (error) return std::nullopt;
  return nlohmann::json::parse(beast::buffers_to_string(buffer.data()));
}

nlohmann::json PageSocket::read_with(const std::string& key) {
  while (const auto message = read())
    if (message->contains(key)) return *message;
  throw std::runtime_error("the console has closed before it sent '" + key + "': " + close_reason());
}

int PageSocket::close_code() const { return socket_->stream.reason().code; }
std::string PageSocket::close_reason() const {
  const auto& reason = socket_->stream.reason().reason;
  return {reason.data(), reason.size()};
}

void PageSocket::cut() {
  tcp::socket& plain = socket_->stream.next_layer();
  plain.set_option(asio::socket_base::linger(true, 0));
  plain.close();
}

}  // namespace jarol::tests

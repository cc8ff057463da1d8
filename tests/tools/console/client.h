// What watches a console in a test: a socket as a page has it, and plain requests.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace jarol::tests {

/// "http://127.0.0.1:8080/?token=abc" in parts.
struct Place {
  explicit Place(const std::string& url);
  std::string host, port, target;
  std::string socket_target() const { return "/socket" + target.substr(target.find('?')); }
};

struct HttpAnswer {
  int status = 0;                                // 0: the connection was closed without one
  std::map<std::string, std::string> headers{};  // names in lower case
  std::string body{};
};

/// The bytes as they stand, and what comes until the end; of an answer that is kept alive the first one.
HttpAnswer ask(const Place& place, const std::string& bytes);
HttpAnswer get(const Place& place, const std::string& target, const std::string& headers = "");

/// A connection on which nothing is said.
class SilentConnection {
 public:
  explicit SilentConnection(const Place& place);
  ~SilentConnection();
  SilentConnection(SilentConnection&&) noexcept;

  /// Until the other side closes it.
  void wait_for_end();

 private:
  struct Socket;
  std::unique_ptr<Socket> socket_;
};

class PageSocket {
 public:
  /// Throws std::runtime_error where the server refuses.
  explicit PageSocket(const std::string& url, const std::string& origin = "", int receive_room = 0);
  ~PageSocket();
  PageSocket(PageSocket&&) noexcept;

  void send(const std::string& text);
  void send_bytes(const std::string& bytes);
  /// None: the other side has closed, for the reason that is kept then.
  std::optional<nlohmann::json> read();
  /// The next message that has this key.
  nlohmann::json read_with(const std::string& key);
  int close_code() const;
  std::string close_reason() const;
  /// Without a word, as where a cable is pulled.
  void cut();

 private:
  struct Socket;
  std::unique_ptr<Socket> socket_;
};

}  // namespace jarol::tests

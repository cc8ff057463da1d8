// The server of a console: one page, and a socket on which it gets what is shown and asks for what it may. One thread
// serves all who watch.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "tools/console/feed.h"

namespace jarol::tools::console {

struct ServerOptions {
  std::string listen = "127.0.0.1";                 // an address of this machine
  int port = 0;                                     // 0: any that is free
  std::string page = "/";                           // where the page is that the address leads to
  std::size_t max_message = std::size_t{16} << 10;  // bytes, of what a page sends
  std::size_t max_answers = std::size_t{4} << 20;   // bytes that a page was answered and has not taken
  bool skips = true;                                // a page that is slow goes on with the newest
  bool replays = true;                              // a page that comes gets all that was shown before
};

/// Who asks.
struct Page {
  std::uint64_t number = 0;
  Duration behind{};  // what it shows was so long ago
};

/// What a page asks for; the answer goes to that page alone, empty: there is none. Throws InputError, of
/// which the page is shown the text.
using Answer = std::function<std::string(const Page& page, const std::string& message)>;

/// The page of that number is gone.
using Left = std::function<void(std::uint64_t page)>;

/// Called on the server's thread about thirty times a second: messages for all pages, in order.
using NextMessages = std::function<std::vector<std::string>()>;

class Server {
 public:
  /// `hello` is the first message that each page gets. Throws InputError where the port can't be had.
  Server(const ServerOptions& options, std::string hello, NextMessages next, Answer answer, Left left = {});
  /// Pages have got what there was, as far as they took it within a second, or within five where they are slow and go
  /// on.
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// With the token, without which nobody watches.
  const std::string& url() const;

  /// For the page of that number alone, where it is still there. Any thread, but not from within `answer`.
  void send(std::uint64_t page, std::string message);

  // limits, so that nobody who watches harms the run or others who watch
  static constexpr std::size_t max_clients = 200;
  static constexpr int max_messages_a_second = 100;     // of what a page sends
  static constexpr std::size_t max_history = 64 << 20;  // bytes, for pages that come later

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace jarol::tools::console

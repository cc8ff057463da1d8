#include "tools/bench/watched.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "graph/text/errors.h"
#include "runtime/execute/executor.h"
#include "tools/bench/clock.h"
#include "tools/bench/graphs.h"
#include "tools/bench/message.h"
#include "tools/bench/timing.h"
#include "tools/console/console.h"
#include "tools/drawing/graph/layout.h"

namespace jarol::bench {
namespace {

// Sockets of pages in a process of their own, which ends with this.
class Watchers {
 public:
  Watchers(const std::string& url, int count, bool reads) {
    int ready[2];
    if (::pipe2(ready, O_CLOEXEC) != 0) throw Unfinished("the benchmark has no pipe");
    child_ = ::fork();
    if (child_ < 0) throw Unfinished("the benchmark has no process for those who watch");
    if (child_ == 0) {
      watch(url, count, reads, ready[1]);
      ::_exit(1);
    }
    ::close(ready[1]);
    char all = 0;
    const bool are_there = ::read(ready[0], &all, 1) == 1;
    ::close(ready[0]);
    if (!are_there) throw Unfinished("the benchmark's watchers were not let in");
  }
  ~Watchers() {
    ::kill(child_, SIGKILL);
    ::waitpid(child_, nullptr, 0);
  }
  Watchers(const Watchers&) = delete;
  Watchers& operator=(const Watchers&) = delete;

 private:
  // "http://127.0.0.1:PORT/?token=TOKEN"
  static int open(const std::string& url) {
    const std::size_t colon = url.rfind(':'), slash = url.find('/', colon);
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<std::uint16_t>(std::stoi(url.substr(colon + 1, slash - colon - 1))));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const std::string ask = "GET /socket" + url.substr(url.find('?')) +
                            " HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
                            "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";
    char answer[13] = {};
    if (socket < 0 || ::connect(socket, reinterpret_cast<const sockaddr*>(&to), sizeof to) != 0 ||
        ::write(socket, ask.data(), ask.size()) != static_cast<ssize_t>(ask.size()) ||
        ::recv(socket, answer, 12, MSG_WAITALL) != 12 || std::string(answer) != "HTTP/1.1 101")
      return -1;
    return socket;
  }

  static void watch(const std::string& url, int count, bool reads, int ready) {
    std::vector<pollfd> sockets;
    for (int i = 0; i < count; ++i) {
      sockets.push_back({open(url), POLLIN, 0});
      if (sockets.back().fd < 0) return;
    }
    static_cast<void>(::write(ready, "y", 1));
    static char taken[1 << 16];
    while (!reads) ::pause();
    while (::poll(sockets.data(), sockets.size(), -1) > 0)
      for (pollfd& socket : sockets)
        if (socket.revents != 0 && ::read(socket.fd, taken, sizeof taken) <= 0) socket.fd = -1;
  }

  pid_t child_;
};

// The first task of the instant says how late it is; a run goes on however late that is.
std::string text_of_graph() {
  std::string text = chain(10, [](int) -> std::string { return "period: 1ms, on_fault: hold"; });
  return text.insert(text.find("tasks:\n") + 7, "  a: {type: Stamp, period: 1ms, on_fault: hold}\n");
}

double lateness_watched(const Graph& graph, int watchers, bool reads) {
  tools::console::Console console(
      tools::console::Watched{.run = {graph, "bench", "real", Duration::max()}, .server = {}, .pace = nullptr});
  console.open();
  std::optional<Watchers> all;
  if (watchers > 0) all.emplace(console.url(), watchers, reads);
  return lateness_of_run(graph, 0.99, &console.feed());
}

}  // namespace

Figure measure_watched(const std::string& name, int watchers, bool reads, int repeats) {
  const Graph graph = graph_of(text_of_graph());
  const std::string who = watchers == 0   ? "nobody at its console"
                          : !reads        ? "a page that reads nothing"
                          : watchers == 1 ? "a page that watches"
                                          : std::to_string(watchers) + " pages that watch";
  return compare_lateness(
      name, "lateness at 1 kHz, 99 %, with " + who + " / without a console", 1.2, repeats,
      [&] { return lateness_watched(graph, watchers, reads); }, [&] { return lateness_of_run(graph, 0.99); });
}

Figure measure_layout(const std::string& name, int repeats) {
  const Graph graph = graph_of(meshed(20, 10));
  // the goal is absolute: the floor is its unit, one second
  Figure figure{name, 1e300, "s", 1, 0, 3, "layout of a graph of 200 tasks / 1 s"};
  for (int i = 0; i < std::max(1, repeats / 20); ++i)
    figure.value = std::min(figure.value, seconds_of([&] { keep(tools::lay_out(graph).width); }));
  figure.ratio = figure.value / figure.floor;
  return figure;
}

}  // namespace jarol::bench

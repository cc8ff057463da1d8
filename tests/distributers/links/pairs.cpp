#include "tests/distributers/links/pairs.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <thread>

#include "distributers/links/serial.h"
#include "distributers/links/tcp.h"
#include "distributers/links/udp.h"

namespace jarol::tests {

using namespace std::chrono_literals;
using namespace distributers;
namespace javiator = messages::javiator;

bool wait_for(const std::function<bool()>& done) {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (!done()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(1ms);
  }
  return true;
}

void send_id(Link& link, int id) {
  link.send(messages::refer_to(javiator::MotorSignals{1, 2, 3, 4, static_cast<std::uint16_t>(id)}));
  link.flush();
}

class Line {
 public:
  Line() : ends_{open_end(names_[0]), open_end(names_[1])} {
    thread_ = std::thread([this] {
      while (interrupter_.wait(-1, 0ms) != Interrupter::Woken::interrupted) {
        pollfd polled[] = {{ends_[0].get(), POLLIN, 0}, {ends_[1].get(), POLLIN, 0}};
        poll(polled, 2, 5);
        for (int i = 0; i < 2; ++i) {
          char room[4096];
          const auto length = ::read(ends_[static_cast<std::size_t>(i)].get(), room, sizeof room);
          if (length > 0 &&
              ::write(ends_[static_cast<std::size_t>(1 - i)].get(), room, static_cast<std::size_t>(length)) != length)
            FAIL("a line lost bytes");
        }
      }
    });
  }
  ~Line() {
    interrupter_.interrupt();
    thread_.join();
  }
  const std::string& name(std::size_t end) const { return names_[end]; }

 private:
  static Descriptor open_end(std::string& name) {
    Descriptor end(posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK));
    REQUIRE(grantpt(end.get()) == 0);
    REQUIRE(unlockpt(end.get()) == 0);
    name = ptsname(end.get());
    return end;
  }
  std::string names_[2];
  std::array<Descriptor, 2> ends_;
  Interrupter interrupter_;
  std::thread thread_;
};

Pair::Pair() = default;
Pair::Pair(Pair&&) noexcept = default;
Pair::~Pair() = default;

std::unique_ptr<Link> make(std::unique_ptr<Transport> transport, const LinkOptions& options) {
  return std::make_unique<Link>(std::move(transport), javiator::message_set(), options);
}

namespace {

// The one that listens is connected first, so that the system chooses its port.
template <class Listens>
Pair connected(std::unique_ptr<Listens> listens, const std::string& host,
               const std::function<std::unique_ptr<Transport>(const Address&)>& dials, const LinkOptions& options) {
  Pair pair;
  const Listens& transport = *listens;
  pair.one = make(std::move(listens), options);
  pair.one->connect();
  pair.other = make(dials(Address::parse(host + ":" + std::to_string(transport.port()))), options);
  pair.other->connect();
  return pair;
}

}  // namespace

Pair udp(const std::string& host, const LinkOptions& options) {
  const Address any = Address::parse(host + ":0");
  return connected(
      std::make_unique<UdpTransport>(any, Address{}), host,
      [&](const Address& peer) { return std::make_unique<UdpTransport>(any, peer); }, options);
}

Pair tcp(const std::string& host, const LinkOptions& options) {
  return connected(
      std::make_unique<TcpServer>(Address::parse(host + ":0")), host,
      [](const Address& peer) { return std::make_unique<TcpClient>(peer); }, options);
}

Pair serial(const LinkOptions& options) {
  Pair pair;
  pair.line = std::make_unique<Line>();
  pair.one = make(std::make_unique<SerialTransport>(pair.line->name(0), 115200), options);
  pair.other = make(std::make_unique<SerialTransport>(pair.line->name(1), 115200), options);
  pair.one->connect();
  pair.other->connect();
  return pair;
}

// The other end speaks first: some learn their peer from that. Again after growing pauses, so that few are under way
// in the end.
bool meet(Pair& pair) {
  Ids at_one, at_other;
  const auto receives = [](Link& link, Ids& at, std::chrono::milliseconds pause) {
    for (const auto end = std::chrono::steady_clock::now() + pause;; std::this_thread::sleep_for(1ms)) {
      link.receive(at);
      if (!at.ids.empty() || std::chrono::steady_clock::now() > end) return !at.ids.empty();
    }
  };
  for (auto pause = 2ms; pause < patience; pause *= 2) {
    send_id(*pair.other, 60000);
    if (!receives(*pair.one, at_one, pause)) continue;
    send_id(*pair.one, 60000);
    if (receives(*pair.other, at_other, pause)) return true;
  }
  return false;
}

}  // namespace jarol::tests

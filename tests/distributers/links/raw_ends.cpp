#include "tests/distributers/links/raw_ends.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <thread>

#include "distributers/links/serial.h"
#include "distributers/links/tcp.h"
#include "distributers/links/udp.h"

namespace jarol::tests {
namespace {

using namespace jarol::distributers;
using namespace std::chrono_literals;

const Address any = Address::parse("127.0.0.1:0");

Address at_port(int port) { return any.with_port(port); }

std::unique_ptr<Link> connected(std::unique_ptr<Transport> transport, const messages::MessageSet& set,
                                const LinkOptions& options) {
  auto link = std::make_unique<Link>(std::move(transport), set, options);
  link->connect();
  return link;
}

class UdpEnd : public RawEnd {
 public:
  UdpEnd(const messages::MessageSet& set, const LinkOptions& options) {
    auto transport = std::make_unique<UdpTransport>(any, Address{});
    const UdpTransport& at = *transport;
    link = connected(std::move(transport), set, options);
    datagrams = true;
    end_ = Descriptor(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
    const Address to = at_port(at.port());
    REQUIRE(connect(end_.get(), to.get(), to.size()) == 0);
  }
};

class TcpClientEnd : public RawEnd {
 public:
  TcpClientEnd(const messages::MessageSet& set, const LinkOptions& options) : socket_(listen_at(any)) {
    link = connected(std::make_unique<TcpClient>(at_port(port_of(socket_))), set, options);
    for (const auto end = std::chrono::steady_clock::now() + 20s; !end_ && std::chrono::steady_clock::now() < end;) {
      end_ = accept_from(socket_);
      std::this_thread::sleep_for(1ms);
    }
    REQUIRE(end_);
  }

 private:
  Descriptor socket_;
};

class TcpServerEnd : public RawEnd {
 public:
  TcpServerEnd(const messages::MessageSet& set, const LinkOptions& options) {
    auto transport = std::make_unique<TcpServer>(any);
    const TcpServer& at = *transport;
    link = connected(std::move(transport), set, options);
    end_ = Descriptor(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    const Address to = at_port(at.port());
    REQUIRE(connect(end_.get(), to.get(), to.size()) == 0);
  }
};

class SerialEnd : public RawEnd {
 public:
  SerialEnd(const messages::MessageSet& set, const LinkOptions& options) {
    end_ = Descriptor(posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC));
    REQUIRE(grantpt(end_.get()) == 0);
    REQUIRE(unlockpt(end_.get()) == 0);
    link = connected(std::make_unique<SerialTransport>(ptsname(end_.get()), 115200), set, options);
    // raw only once the link has opened it
    while (count_of(*link, "peers") == 0) std::this_thread::sleep_for(1ms);
  }
};

}  // namespace

void RawEnd::write(std::span<const std::byte> bytes) const {
  do {
    // a datagram may be empty, which write would not send
    const auto length = datagrams ? ::send(end_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL)
                                  : ::write(end_.get(), bytes.data(), bytes.size());
    if (length < 0 && errno == EAGAIN) {
      pollfd polled{end_.get(), POLLOUT, 0};
      poll(&polled, 1, -1);
      continue;
    }
    REQUIRE(length >= 0);
    bytes = bytes.subspan(static_cast<std::size_t>(length));
  } while (!bytes.empty());
}

std::unique_ptr<RawEnd> make_raw_end(const std::string& kind, const messages::MessageSet& set,
                                     const LinkOptions& options) {
  if (kind == "udp") return std::make_unique<UdpEnd>(set, options);
  if (kind == "tcp_client") return std::make_unique<TcpClientEnd>(set, options);
  if (kind == "tcp_server") return std::make_unique<TcpServerEnd>(set, options);
  return std::make_unique<SerialEnd>(set, options);
}

std::uint64_t count_of(const Link& link, const std::string& name) {
  for (const auto& [counted, count] : link.report().counts)
    if (counted == name) return count;
  FAIL("no count of " << name);
  return 0;
}

namespace {

// What was dropped for a flaw, and what was taken.
std::uint64_t sum_of(const Link& link, bool with_taken) {
  std::vector<std::string> names;
  for (std::size_t i = 1; i < messages::packet_error_count; ++i)
    names.push_back("dropped: " + std::string(name_of(static_cast<messages::PacketError>(i))));
  if (with_taken) names.emplace_back("packets in");
  std::uint64_t sum = 0;
  for (const auto& [name, count] : link.report().counts)
    if (std::find(names.begin(), names.end(), name) != names.end()) sum += count;
  return sum;
}

}  // namespace

std::uint64_t flawed(const Link& link) { return sum_of(link, false); }

std::uint64_t looked_at(const Link& link) { return sum_of(link, true); }

}  // namespace jarol::tests

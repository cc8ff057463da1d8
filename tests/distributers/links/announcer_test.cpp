#include "distributers/links/announcer.h"

#include <doctest/doctest.h>
#include <poll.h>

#include <string>

#include "distributers/links/link.h"
#include "distributers/links/udp.h"
#include "distributers/messages/imc.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
namespace imc = messages::imc;

std::string texts(const std::vector<Address>& addresses) {
  std::string text;
  for (const Address& address : addresses) text += address.text() + " ";
  return text;
}

struct Socket {
  Socket() : descriptor(socket(AF_INET, SOCK_DGRAM, 0)) {
    const Address any = Address::parse("0");
    REQUIRE(bind(descriptor.get(), any.get(), any.size()) == 0);
  }
  // Bytes of the next datagram; -1: none comes.
  long next() {
    pollfd polled{descriptor.get(), POLLIN, 0};
    if (poll(&polled, 1, 20'000) != 1) return -1;
    char room[1024];
    return recv(descriptor.get(), room, sizeof room, 0);
  }
  std::string port() const { return std::to_string(port_of(descriptor)); }
  Descriptor descriptor;
};
}  // namespace

TEST_SUITE("distributers/links/announcer") {
  TEST_CASE("addresses are listed, each with a port or a range of ports") {
    CHECK(texts(Announcer::parse("30100")) == "127.0.0.1:30100 ");
    CHECK(texts(Announcer::parse("127.0.0.1:30100-30102, 10.0.0.255:5")) ==
          "127.0.0.1:30100 127.0.0.1:30101 127.0.0.1:30102 10.0.0.255:5 ");
    CHECK(texts(Announcer::parse("7-8,[::1]:9")) == "127.0.0.1:7 127.0.0.1:8 [::1]:9 ");
  }

  TEST_CASE("what is no list of addresses is reported with what would be right") {
    CHECK_THROWS_WITH(Announcer::parse("30104-30100"),
                      "'30104-30100' is no range of ports; write the first and the last of no more than 64");
    CHECK_THROWS_WITH(Announcer::parse("1-65535"),
                      "'1-65535' is no range of ports; write the first and the last of no more than 64");
    CHECK_THROWS_WITH(Announcer::parse(""),
                      "'' is not an address with a port; write it as in 7000, 192.168.2.3:7000 or \"[::1]:7000\"");
  }

  TEST_CASE("what is announced arrives at each address, where somebody listens or not") {
    Socket one, other;
    const std::string nobody = Socket().port();  // free again at once
    const auto to = Announcer::parse(one.port() + "," + nobody + "," + other.port());
    Link link(std::make_unique<UdpTransport>(Address::parse("0"), Address{}, to), imc::message_set(), {});
    link.connect();
    for (int i = 0; i < 3; ++i) {
      link.announce(messages::refer_to(imc::Heartbeat{}));
      link.flush();
      CHECK(one.next() == 22);
      CHECK(other.next() == 22);
    }
    link.disconnect();
  }

  TEST_CASE("what can't be sent to an address is counted there, with the cause, and the others get it") {
    Socket one;
    // nothing can be sent to port 0
    const auto to = Announcer::parse("127.0.0.1:0," + one.port());
    Link link(std::make_unique<UdpTransport>(Address::parse("0"), Address{}, to), imc::message_set(), {});
    link.connect();
    for (int i = 0; i < 3; ++i) {
      link.announce(messages::refer_to(imc::Heartbeat{}));
      link.flush();
      CHECK(one.next() == 22);
    }
    link.disconnect();
    const auto unsent = link.unsent_announcements();
    REQUIRE(unsent.size() == 1);
    CHECK(unsent[0].first == "announcements to 127.0.0.1:0 (Invalid argument)");
    CHECK(unsent[0].second == 3);
    CHECK(link.report().counts.back() ==
          std::pair<std::string, std::uint64_t>("unsent: announcements to 127.0.0.1:0 (Invalid argument)", 3));
  }

  TEST_CASE("who announces itself beyond this machine and listens at its loopback is in doubt") {
    const auto doubt = [](const std::string& listen, const std::string& announce) {
      return UdpTransport(Address::parse(listen), Address{}, Announcer::parse(announce)).doubt();
    };
    CHECK(doubt("6001", "30100-30104,10.0.0.255:30100") ==
          "announces itself to 10.0.0.255:30100, which can't answer, as 127.0.0.1:6001 is reached from this machine "
          "alone; listen at 0.0.0.0:6001");
    CHECK(doubt("[::1]:6001", "[2001:db8::1]:30100") ==
          "announces itself to [2001:db8::1]:30100, which can't answer, as [::1]:6001 is reached from this machine "
          "alone; listen at [::]:6001");
    CHECK(doubt("0.0.0.0:6001", "10.0.0.255:30100") == "");
    CHECK(doubt("6001", "30100-30104") == "");
  }

  TEST_CASE("only packets of the source that was named and to this system count, and make their sender the peer") {
    const auto make = [](std::uint64_t id, const Address& listen, const Address& peer, const LinkOptions& options) {
      LinkOptions its = options;
      its.header.emplace_back("src", id);
      auto link = std::make_unique<Link>(std::make_unique<UdpTransport>(listen, peer), imc::message_set(), its);
      link->connect();
      return link;
    };
    LinkOptions options;
    options.accept.emplace_back("src", 0xd1);
    const auto link = make(0x4001, Address::parse("0"), {}, options);
    const Address at = Address::parse(link->transport().address().substr(6));
    const auto to = [](std::uint64_t system) {
      LinkOptions its;
      its.header.emplace_back("dst", system);
      return its;
    };
    const auto right = make(0xd1, Address::parse("0"), at, to(0x4001)), wrong = make(0xd2, Address::parse("0"), at, {}),
               elsewhere = make(0xd1, Address::parse("0"), at, to(0x4002));
    const auto count = [&](const std::string& name) {
      for (const auto& [counted, n] : link->report().counts)
        if (counted == name) return n;
      return std::uint64_t{0};
    };
    const auto waits = [&](const std::string& name, std::uint64_t wanted) {
      for (int i = 0; i < 20'000 && count(name) != wanted; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      return count(name);
    };
    wrong->send(messages::refer_to(imc::Heartbeat{}));
    wrong->flush();
    CHECK(waits("dropped: other source", 1) == 1);
    CHECK(count("peers") == 0);
    elsewhere->send(messages::refer_to(imc::Heartbeat{}));
    elsewhere->flush();
    CHECK(waits("dropped: other destination", 1) == 1);
    CHECK(count("peers") == 0);
    right->send(messages::refer_to(imc::Heartbeat{}));
    right->flush();
    CHECK(waits("peers", 1) == 1);
    CHECK(count("dropped: other source") == 1);
    // what a system says to itself, all that hear it may know
    const auto listens = make(0x4001, Address::parse("0"), {}, options);
    const auto itself =
        make(0xd1, Address::parse("0"), Address::parse(listens->transport().address().substr(6)), to(0xd1));
    itself->send(messages::refer_to(imc::Heartbeat{}));
    itself->flush();
    for (int i = 0; i < 20'000 && listens->report().heard == 0; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    CHECK(listens->report().heard == 1);
  }
}

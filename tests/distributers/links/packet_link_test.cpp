#include "distributers/links/packet_link.h"

#include <doctest/doctest.h>

#include <thread>

#include "distributers/distributers.h"
#include "distributers/links/announcer.h"
#include "distributers/links/udp.h"
#include "distributers/messages/javiator.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
using namespace std::chrono_literals;
namespace javiator = messages::javiator;

std::unique_ptr<Link> make(const std::string& text) {
  Problems problems;
  const Yaml yaml = read_yaml(std::make_shared<Source>(Source{"link.yaml", text}), problems);
  NamedList<LinkType> known;
  add_links(known);
  auto link = known.find(yaml.find("type")->text)->make_link(yaml, javiator::message_set(), "link", problems);
  problems.throw_if_any();
  return link;
}

std::string report_on(const std::string& text) {
  try {
    make(text);
  } catch (const SpecError& error) { return error.what(); }
  return "";
}

std::uint64_t count_of(const Link& link, const std::string& name) {
  for (const auto& [counted, count] : link.report().counts)
    if (counted == name) return count;
  return 0;
}

// Of a hundred packets, how many the output port refuses while nobody sends them.
std::uint64_t refused(const std::string& port) {
  const auto link = make("{type: udp, listen: 0" + port + "}");
  for (int i = 0; i < 100; ++i) link->send(messages::refer_to(javiator::MotorSignals{}));
  return count_of(*link, "unsent: output port full");
}

// Of a hundred packets that have come before anyone looks, the ids of the first and the last, and how many they are.
std::vector<std::size_t> kept(const std::string& port) {
  struct Ids : messages::Receiver {
    void receive(messages::MessageRef message) override { ids.push_back(message.as<javiator::MotorSignals>()->id); }
    std::vector<std::size_t> ids;
  };
  const auto link = make("{type: udp, listen: 0" + port + "}");
  link->connect();
  const auto sender = make("{type: udp, peer: '" + link->transport().address().substr(6) + "'}");
  sender->connect();
  for (std::uint16_t id = 0; id < 100; ++id) {
    sender->send(messages::refer_to(javiator::MotorSignals{0, 0, 0, 0, id}));
    sender->flush();
    for (int i = 0; i < 20000 && count_of(*link, "packets in") <= id; ++i) std::this_thread::sleep_for(1ms);
  }
  Ids got;
  link->receive(got);
  return {got.ids.empty() ? 0 : got.ids.front(), got.ids.empty() ? 0 : got.ids.back(), got.ids.size()};
}
}  // namespace

TEST_SUITE("distributers/links/packet_link") {
  TEST_CASE("'port' chooses kind and size of the output port; it is plain and holds 64 by default") {
    CHECK(refused("") == 36);
    CHECK(refused(", port: {out: {packets: 4}}") == 96);
    CHECK(refused(", port: {out: {kind: push, packets: 4}}") == 0);
    CHECK(refused(", port: {in: {kind: plain, packets: 4}}") == 36);
  }

  TEST_CASE("'port' chooses kind and size of the input port; it is push and holds 256 by default") {
    CHECK(kept("") == std::vector<std::size_t>{0, 99, 100});
    CHECK(kept(", port: {in: {packets: 4}}") == std::vector<std::size_t>{96, 99, 4});
    CHECK(kept(", port: {in: {kind: plain, packets: 4}}") == std::vector<std::size_t>{0, 3, 4});
  }

  TEST_CASE("nothing is reached from beyond this machine unless that is stated") {
    const auto link = [](const std::string& text) { return make("{" + text + "}")->transport().text(); };
    CHECK(link("type: udp, listen: 7000") == "udp 127.0.0.1:7000");
    CHECK(link("type: udp, peer: 7000") == "udp 127.0.0.1:0 with 127.0.0.1:7000");
    CHECK(link("type: udp, peer: '127.1.2.3:7000'") == "udp 127.0.0.1:0 with 127.1.2.3:7000");
    CHECK(link("type: udp, peer: '[::1]:7000'") == "udp [::1]:0 with [::1]:7000");
    CHECK(link("type: tcp_server, listen: 7000") == "tcp at 127.0.0.1:7000");
    CHECK(link("type: tcp_client, peer: 7000") == "tcp to 127.0.0.1:7000");
    // told by the address of the peer, or of where it listens
    CHECK(link("type: udp, peer: '192.0.2.1:7000'") == "udp 0.0.0.0:0 with 192.0.2.1:7000");
    CHECK(link("type: udp, peer: '[2001:db8::1]:7000'") == "udp [::]:0 with [2001:db8::1]:7000");
    CHECK(link("type: udp, listen: '0.0.0.0:7000'") == "udp 0.0.0.0:7000");
  }

  TEST_CASE("a port that can't be is reported with what would be right") {
    CHECK(report_on("type: udp\nlisten: 0\nport: {in: {packets: 0}, out: {packets: 4097}}\n") ==
          "link.yaml:3:22: error: port 'in' of the link holds from 1 to 4096 packets, not 0\n"
          "  port: {in: {packets: 0}, out: {packets: 4097}}\n"
          "                       ^\n"
          "link.yaml:3:41: error: port 'out' of the link holds from 1 to 4096 packets, not 4097\n"
          "  port: {in: {packets: 0}, out: {packets: 4097}}\n"
          "                                          ^");
  }

  TEST_CASE("who listens at all addresses is announced by the one from which the announcement goes") {
    const auto address = [](const std::string& text) {
      const auto link = make("{type: udp, " + text + "}");
      link->connect();
      const std::string reported = link->transport().address();
      const auto& udp = static_cast<const UdpTransport&>(link->transport());
      const std::string port = ":" + std::to_string(udp.port());
      return reported.substr(0, reported.rfind(':')) +
             (reported.substr(reported.size() - port.size()) == port ? " and its port" : "");
    };
    CHECK(address("listen: '0.0.0.0:0', announce: '127.0.0.1:30100-30104'") == "udp://127.0.0.1 and its port");
    CHECK(address("peer: '127.0.0.1:9', announce: '127.1.2.3:30100'") == "udp://127.0.0.1 and its port");
    CHECK(address("listen: '[::]:0', announce: '[::1]:30100'") == "udp://[::1] and its port");
    CHECK(address("listen: '[::]:0', announce: '127.0.0.1:30100'") == "udp://127.0.0.1 and its port");
    CHECK(address("listen: '127.0.0.2:0', announce: '127.0.0.1:30100'") == "udp://127.0.0.2 and its port");
  }

  TEST_CASE("where to announce is checked with the link") {
    CHECK(report_on("type: udp\nlisten: 0\nannounce: 9-7\n") ==
          "link.yaml:3:11: error: '9-7' is no range of ports; write the first and the last of no more than 64\n"
          "  announce: 9-7\n"
          "            ^");
  }
}

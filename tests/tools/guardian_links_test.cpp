// What a guardian sends over which link: those of one program, each with its own peer.
#include <doctest/doctest.h>
#include <poll.h>
#include <sys/socket.h>

#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "distributers/guardian/guardian.h"
#include "distributers/links/descriptor.h"
#include "distributers/messages/imc.h"
#include "distributers/messages/javiator.h"
#include "tests/distributers/links/open_link.h"

namespace {
using namespace jarol;
using distributers::Descriptor;

// A way to a peer, and what the peer gets.
struct Way {
  Way() {
    int ends[2];
    REQUIRE(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) == 0);
    ours = Descriptor(ends[0]);
    theirs = Descriptor(ends[1]);
  }
  // Until the other end is gone.
  std::string all() {
    ours.close();
    std::string text;
    char room[4096];
    pollfd ready{theirs.get(), POLLIN, 0};
    while (::poll(&ready, 1, 20'000) > 0) {
      const ssize_t length = ::recv(theirs.get(), room, sizeof room, 0);
      if (length <= 0) break;
      text.append(room, static_cast<std::size_t>(length));
    }
    return text;
  }
  Descriptor ours, theirs;
};

std::vector<std::byte> bytes_of(const std::string& text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

// Takes whoever speaks for a peer.
struct Believing : distributers::ByteSink {
  bool take(std::span<const std::byte>, std::uint32_t) override { return true; }
  void begin_stream() override {}
};

constexpr const char* probe = "?";

// Its datagrams but the probes, in one.
std::string heard_by(const tests::Speaker& speaker) {
  std::string all;
  for (auto bytes = speaker.heard(); !bytes.empty(); bytes = speaker.heard()) {
    const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (text != probe) all += text;
  }
  return all;
}

std::string times(int count, const std::string& text) {
  std::string all;
  for (int i = 0; i < count; ++i) all += text;
  return all;
}
}  // namespace

TEST_SUITE("tools/guardian_links") {
  TEST_CASE("a link of a set that only a plugin knows gets its packets, and so do the links beside it") {
    messages::MessageSet of_plugin = messages::javiator::message_set();
    of_plugin.name = "rover";
    const std::vector<std::vector<std::byte>> to_rover{bytes_of("brake")}, to_helicopter{bytes_of("motors off")},
        to_lamp{bytes_of("dark")};
    std::vector<Way> ways(3);
    auto guardian = std::make_unique<distributers::Guardian>(JAROL_COMMAND);
    const std::vector<distributers::Holder*> holders{
        guardian->add(of_plugin, "rover's line", to_rover),
        guardian->add(messages::javiator::message_set(), "helicopter's line", to_helicopter),
        guardian->add(of_plugin, "lamp's line", to_lamp)};
    guardian->await_ready();
    for (std::size_t i = 0; i < ways.size(); ++i) holders[i]->hold(ways[i].ours.get(), {});
    guardian->arm();
    guardian.reset();  // as if the program were gone
    // again, as datagrams may be lost
    CHECK(ways[0].all() == times(5, "brake"));
    CHECK(ways[1].all() == times(5, "motors off"));
    CHECK(ways[2].all() == times(5, "dark"));
  }

  TEST_CASE("a link with several peers sends to each that it knows, and to none that has left") {
    const std::vector<std::vector<std::byte>> packets{bytes_of("motors off, "), bytes_of("lamps off, ")};
    auto guardian = std::make_unique<distributers::Guardian>(JAROL_COMMAND);
    distributers::Holder* const holder = guardian->add(messages::javiator::message_set(), "consoles", packets);
    guardian->await_ready();
    distributers::UdpTransport consoles(tests::any, {}, {}, std::chrono::hours(1), 3);
    consoles.holder = holder;
    consoles.open();
    distributers::Interrupter interrupter;
    Believing sink;
    std::thread receiving([&] { consoles.receive(interrupter, sink); });
    const auto address = tests::any.with_port(consoles.port());
    const tests::Speaker one(address, SOCK_DGRAM), other(address, SOCK_DGRAM);
    std::string left;
    {
      const tests::Speaker leaves(address, SOCK_DGRAM);
      left = leaves.name;
      for (const tests::Speaker* each : {&one, &other, &leaves}) each->say(1);
      REQUIRE(tests::wait_for([&] { return consoles.counts.connected == 3; }));
    }
    REQUIRE(tests::wait_for([&] {
      consoles.send(bytes_of(probe));
      return consoles.counts.closed == 1;
    }));
    // who has its port now is no console
    const auto its = distributers::Address::parse(left);
    const Descriptor heir(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
    REQUIRE(::bind(heir.get(), its.get(), its.size()) == 0);
    interrupter.interrupt();
    receiving.join();
    consoles.holder = nullptr;
    guardian->arm();
    guardian.reset();  // as if the program were gone
    CHECK(heard_by(one) == times(5, "motors off, lamps off, "));
    CHECK(heard_by(other) == times(5, "motors off, lamps off, "));
    char byte = 0;
    CHECK(::recv(heir.get(), &byte, 1, MSG_DONTWAIT) < 0);
  }
}

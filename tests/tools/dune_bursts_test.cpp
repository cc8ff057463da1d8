// The most that a real DUNE sends in a short time, through a link as the shipped graph of the submarine has it.
#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "distributers/interfaces/typed.h"
#include "distributers/lauv/vehicle.h"
#include "distributers/links/link.h"
#include "distributers/links/udp.h"
#include "tests/distributers/links/open_link.h"
#include "tests/tools/recorded_packets.h"
#include "tools/commands/run/load_graph.h"

namespace {
using namespace jarol;
using distributers::Link;
using distributers::UdpTransport;
using test::Packet;

// How long DUNE's packets wait at most in a run that keeps time: the shortest period of what it reads from there.
Duration reading_period() {
  const Loaded loaded = tools::load_without_systems("specs/exolauv.yaml", {.profile = "dune", .set = {}});
  Duration shortest = std::chrono::hours(1);
  for (const Communicator& c : loaded.graph->communicators)
    if (c.distributer && loaded.graph->distributers[*c.distributer].name == "dune" && c.direction == Direction::in)
      shortest = std::min(shortest, c.period);
  return shortest;
}

// A run that reads at these instants, and what came.
struct Read : messages::Receiver {
  Read() {
    auto transport = std::make_unique<UdpTransport>(tests::any, distributers::Address{});
    const UdpTransport& at = *transport;
    link = std::make_unique<Link>(std::move(transport), distributers::LauvVehicle::message_set(),
                                  distributers::LinkOptions{});
    link->connect();
    dune = std::make_unique<tests::Speaker>(tests::any.with_port(at.port()), SOCK_DGRAM);
  }
  void receive(messages::MessageRef) override { ++count; }
  // No more at once than the socket holds, however little that is.
  void say(const Packet& packet) {
    dune->say(packet.bytes);
    constexpr std::uint64_t at_once = 32;
    if (++said % at_once == 0) settle();
  }
  void settle() {
    REQUIRE(tests::wait_for([&] { return tests::count_of(*link, "packets in") == said; }));
  }
  void read() {
    settle();
    const std::uint64_t before = count;
    link->receive(*this);
    most = std::max(most, count - before);
  }

  std::unique_ptr<Link> link;
  std::unique_ptr<tests::Speaker> dune;
  std::uint64_t said = 0, count = 0, most = 0;
};

// All of the recording, read every so often from `begin` on; how many packets waited at most.
std::uint64_t most_waiting(const std::vector<Packet>& packets, double period, double begin) {
  Read run;
  double next = begin;
  for (const Packet& packet : packets) {
    // where nothing was recorded in between, nothing waits
    for (; next < packet.seconds; next += period)
      if (run.said > run.count) run.read();
    run.say(packet);
  }
  run.read();
  CHECK(run.count == packets.size());
  CHECK(tests::count_of(*run.link, "dropped: overwritten by newer") == 0);
  return run.most;
}
}  // namespace

TEST_SUITE("tools/dune_bursts") {
  TEST_CASE(
      "what DUNE sends at its start and when two sensors fail waits for the run, one that is late by a period too") {
    const double period = seconds(reading_period());
    CHECK(period == 0.05);
    const auto packets = test::packets_of("tests/data/dune-bursts.packets");
    CHECK(packets.size() == 660);
    for (const int periods : {1, 2}) {
      CAPTURE(periods);
      std::uint64_t most = 0;
      // wherever the run's instants lie among the packets
      for (int shift = 0; shift < 10 * periods; ++shift)
        most = std::max(most, most_waiting(packets, periods * period, 0.1 * shift * period));
      // of which a plain port would have refused all but 64
      CHECK(most >= (periods == 1 ? 190 : 230));
      MESSAGE(most << " packets waited in " << 1e3 * periods * period << " ms");
    }
  }
}

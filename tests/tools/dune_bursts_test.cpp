// The most that a real DUNE sends in a short time, through a UDP link with the default ports, which the shipped graph
// of the submarine has, too; but packets of every sender count here.
#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "distributers/interfaces/typed.h"
#include "distributers/lauv/vehicle.h"
#include "distributers/links/link.h"
#include "distributers/links/udp.h"
#include "tests/distributers/links/open_link.h"
#include "tests/how_many.h"
#include "tests/tools/recorded_packets.h"
#include "tools/commands/run/load_graph.h"

namespace {
using namespace jarol;
using distributers::Link;
using distributers::UdpTransport;
using test::Packet;

// How long DUNE's packets wait at most in a run that keeps time: the shortest period of what `dune` reads.
Duration reading_period(const Graph& graph, const Distributer& dune) {
  Duration shortest = std::chrono::hours(1);
  for (const Communicator& c : graph.communicators)
    if (c.distributer && &graph.distributers[*c.distributer] == &dune && c.direction == Direction::in)
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
  // Without a pause: it is done some hundred times.
  void settle() const {
    const auto end = std::chrono::steady_clock::now() + tests::patience;
    while (tests::count_of(*link, "packets in") < said && std::chrono::steady_clock::now() < end)
      std::this_thread::yield();
    REQUIRE(tests::count_of(*link, "packets in") == said);
  }
  void read() {
    settle();
    const std::uint64_t before = count;
    link->receive(*this);
    max_waiting = std::max(max_waiting, count - before);
  }

  std::unique_ptr<Link> link;
  std::unique_ptr<tests::Speaker> dune;
  std::uint64_t said = 0, count = 0, max_waiting = 0;
};

// All of the recording, read every so often from `begin` on; how many packets waited at most.
std::uint64_t count_waiting(const std::vector<Packet>& packets, double period, double begin) {
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
  return run.max_waiting;
}
}  // namespace

TEST_SUITE("tools/dune_bursts") {
  TEST_CASE(
      "what DUNE sends at its start and when two sensors fail waits for the run: 197 packets at most in a period, "
      "246 in two, where the run is late by one") {
    const Loaded loaded = tools::load_without_systems("specs/exolauv.yaml", {.profile = "dune", .set = {}});
    const auto& distributers = loaded.graph->distributers;
    const auto dune =
        std::find_if(distributers.begin(), distributers.end(), [](const Distributer& d) { return d.name == "dune"; });
    REQUIRE(dune != distributers.end());
    CHECK(dune->link.find("type")->text == "udp");
    CHECK(dune->link.find("port") == nullptr);
    const double period = seconds(reading_period(*loaded.graph, *dune));
    CHECK(period == 0.05);
    const auto packets = test::packets_of("tests/data/dune-bursts.packets");
    CHECK(packets.size() == 660);
    struct Case {
      int periods;
      std::uint64_t max_waiting;
      int widest_shift;  // tenths of a period: where so many wait
    };
    for (const Case& each : {Case{1, 197, 6}, Case{2, 246, 16}}) {
      CAPTURE(each.periods);
      std::uint64_t max_waiting = 0;
      // wherever the run's instants lie among the packets
      const int begin = tests::tries_less ? each.widest_shift : 0;
      const int end = tests::tries_less ? each.widest_shift + 1 : 10 * each.periods;
      for (int shift = begin; shift < end; ++shift)
        max_waiting = std::max(max_waiting, count_waiting(packets, each.periods * period, 0.1 * shift * period));
      CHECK(max_waiting == each.max_waiting);
    }
  }
}

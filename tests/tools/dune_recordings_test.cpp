// What a real DUNE sent in a dive, and with water in its hull, as exolauv.yaml's profile for it takes it.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "distributers/interfaces/typed.h"
#include "distributers/lauv/vehicle.h"
#include "distributers/messages/packet.h"
#include "graph/values/value.h"
#include "tasks/lauv/supervisor.h"
#include "tools/commands/run/load_graph.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;
using distributers::LauvVehicle;
using tasks::Alarm;
using tasks::Instruments;
using tasks::LauvSupervisor;

struct Packet {
  double seconds = 0;  // since the first of the recording
  std::vector<std::byte> bytes;
};

// Records of a time, a length and a packet; what was sent before `from`, labels alone, comes then.
std::vector<Packet> packets_of(const std::string& file, double from = 0) {
  std::ifstream in(file, std::ios::binary);
  const std::string all((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  std::vector<Packet> packets;
  for (std::size_t at = 0; at + 10 <= all.size();) {
    Packet packet;
    std::uint16_t length = 0;
    std::memcpy(&packet.seconds, all.data() + at, 8);
    std::memcpy(&length, all.data() + at + 8, 2);
    packet.bytes.resize(length);
    std::memcpy(packet.bytes.data(), all.data() + at + 10, length);
    at += 10U + length;
    packet.seconds = std::max(packet.seconds, from);
    packets.push_back(std::move(packet));
  }
  return packets;
}

struct Nowhere : messages::Receiver {
  void receive(messages::MessageRef message) override {
    if (message.as<messages::imc::EntityList>() != nullptr) ++asked;
  }
  int asked = 0;
};

// The supervisor every 50 ms beside the packets as they came.
struct Watched {
  explicit Watched(const std::string& profile) {
    Overrides overrides;
    if (!profile.empty()) overrides.profile = profile;
    const Loaded loaded = tools::load_graph("specs/exolauv.yaml", overrides);
    for (const Distributer& d : loaded.graph->distributers)
      if (d.name == "dune") vehicle = *static_cast<const distributers::LauvVehicleParameters*>(d.parameters.data());
    for (const Task& t : loaded.graph->tasks)
      if (t.name == "supervisor") supervisor = *static_cast<const LauvSupervisor::Param*>(t.parameters.data());
  }

  void run(const std::vector<Packet>& packets) {
    distributers::Typed<LauvVehicle> adapter(vehicle);
    messages::PacketReader reader(LauvVehicle::message_set());
    LauvSupervisor::State state;
    LauvSupervisor::In in;
    LauvSupervisor::Out out;
    std::size_t next = 0;
    const double begin = packets.front().seconds, end = packets.back().seconds;
    for (std::int64_t k = 0; begin + 0.05 * static_cast<double>(k) <= end; ++k) {
      const double now = begin + 0.05 * static_cast<double>(k);
      for (; next < packets.size() && packets[next].seconds <= now; ++next) {
        REQUIRE(reader.read(packets[next].bytes) == messages::PacketError::none);
        adapter.receive(reader.message());
      }
      adapter.reach(50ms * k, system);
      adapter.take<&LauvVehicle::In::instruments>(in.instruments);
      LauvSupervisor::run(supervisor, Tick{50ms * k, k, 50ms}, in, state, out);
      seen.push_back(in.instruments);
      if (out.condition.alarm != Alarm::none && alarms.insert(out.condition.alarm).second) alarmed_at = now;
    }
  }

  distributers::LauvVehicleParameters vehicle;
  LauvSupervisor::Param supervisor;
  Nowhere system;
  std::vector<Instruments> seen;
  std::set<Alarm> alarms;
  double alarmed_at = 0;
};
}  // namespace

TEST_SUITE("tools/dune_recordings") {
  TEST_CASE("a dive of DUNE is guarded from begin to end, and nothing is alarmed") {
    Watched dive("dune");
    dive.run(packets_of("tests/data/dune-dive.packets"));
    CHECK(dive.alarms.empty());
    const Instruments& last = dive.seen.back();
    // all that is fitted has spoken, and is what it is called
    CHECK(last.depth.value == doctest::Approx(3).scale(0).epsilon(0.01));
    CHECK(last.pressure.value == doctest::Approx(1013.25 + 0.01 * 9810 * last.depth.value).scale(0).epsilon(0.02));
    CHECK(last.altitude.value < 2);  // the echo sounder, which looks ahead, has 29.5 m
    CHECK(last.water_temperature.value < 15);
    CHECK(last.forces.z == doctest::Approx(-9.81).scale(0).epsilon(0.05));
    for (const auto count : {last.rates.count, last.heading.count, last.velocity.count, last.rpm.count,
                             last.place.count, last.conductivity.count, last.leak.count, last.leak1.count})
      CHECK(count > 0);
    CHECK(last.leak2.count == -1);
    CHECK(last.leak3.count == -1);
    CHECK(last.hull_temperature.count == -1);
    CHECK(last.voltage.count == -1);
    CHECK(last.current.count == -1);
  }

  TEST_CASE("water at both leak sensors is seen within a second, and at no instant missed after that") {
    Watched leak("dune");
    const auto packets = packets_of("tests/data/dune-leak.packets", 15);
    leak.run(packets);
    CHECK(leak.alarms == std::set<Alarm>{Alarm::leak});
    double first = 0;
    messages::PacketReader reader(LauvVehicle::message_set());
    for (const Packet& packet : packets) {
      REQUIRE(reader.read(packet.bytes) == messages::PacketError::none);
      const auto* state = reader.message().as<messages::imc::EntityState>();
      if (first == 0 && state != nullptr && state->state == messages::imc::EntityState::State::FAILURE)
        first = packet.seconds;
    }
    CHECK(first > 0);
    CHECK(leak.alarmed_at >= first);
    CHECK(leak.alarmed_at < first + 0.1);
    bool wet = false;
    for (const Instruments& i : leak.seen) {
      CHECK((!wet || (i.leak.value == 1 && i.leak1.value == 1)));
      wet = wet || i.leak.value == 1;
    }
    CHECK(wet);
  }

  TEST_CASE("one wet sensor of two is a leak, and so is one of two that falls silent, each by its name") {
    Watched leak("dune");
    auto packets = packets_of("tests/data/dune-leak.packets", 15);
    const auto is_of = [](const Packet& packet, std::uint8_t entity) {
      messages::PacketReader reader(LauvVehicle::message_set());
      return reader.read(packet.bytes) == messages::PacketError::none &&
             reader.message().as<messages::imc::EntityState>() != nullptr &&
             distributers::Entities::sender_of(reader.message()) == entity;
    };
    constexpr std::uint8_t nose = 18, tail = 17;
    SUBCASE("wet") {
      bool wet = false;
      std::vector<std::byte> dry;
      for (Packet& packet : packets) {
        if (!is_of(packet, nose)) continue;
        messages::PacketReader reader(LauvVehicle::message_set());
        REQUIRE(reader.read(packet.bytes) == messages::PacketError::none);
        // the nose stays dry: its packets of before, once more
        wet = wet ||
              reader.message().as<messages::imc::EntityState>()->state == messages::imc::EntityState::State::FAILURE;
        if (!wet) dry = packet.bytes;
        if (wet) packet.bytes = dry;
      }
      leak.run(packets);
      CHECK(leak.alarms == std::set<Alarm>{Alarm::leak1});
      CHECK(leak.seen.back().leak.value == 0);
      CHECK(leak.seen.back().leak1.value == 1);
    }
    SUBCASE("silent") {
      // before any water, and nothing from the tail's sensor after 16.5 s: it reports last at 16.03 s
      std::erase_if(packets, [&](const Packet& p) { return p.seconds > 18.5 || (p.seconds > 16.5 && is_of(p, tail)); });
      leak.supervisor.sensor_timeout = 1.2;
      leak.run(packets);
      CHECK(leak.alarms == std::set<Alarm>{Alarm::leak1});
      CHECK(leak.alarmed_at > 17.2);
      CHECK(leak.alarmed_at < 17.4);
    }
  }

  TEST_CASE("who has no labels yet is asked for them, at most every second") {
    Watched leak("dune");
    auto packets = packets_of("tests/data/dune-leak.packets", 15);
    std::erase_if(packets, [](const Packet& packet) {
      messages::PacketReader reader(LauvVehicle::message_set());
      reader.read(packet.bytes);
      return reader.message().as<messages::imc::EntityInfo>() != nullptr ||
             reader.message().as<messages::imc::EntityList>() != nullptr;
    });
    leak.run(packets);
    CHECK(leak.system.asked >= 9);
    CHECK(leak.system.asked <= 12);
    CHECK(leak.seen.back().leak.count == 0);  // nobody knows which they are
  }
}

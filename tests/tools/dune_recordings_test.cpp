// What a real DUNE sent in a dive, and with water in its hull, as exolauv.yaml's profile for it takes it.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "distributers/interfaces/typed.h"
#include "distributers/lauv/vehicle.h"
#include "distributers/messages/packet.h"
#include "graph/math/geometry.h"
#include "graph/values/value.h"
#include "tasks/lauv/fins.h"
#include "tasks/lauv/supervisor.h"
#include "tests/tools/recorded_packets.h"
#include "tools/commands/run/load_graph.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;
using distributers::LauvVehicle;
using tasks::Alarm;
using tasks::FinState;
using tasks::FinWatch;
using tasks::Instruments;
using tasks::LauvSupervisor;
using test::Packet;
using test::packets_of;

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
      if (t.name == "supervisor")
        supervisor = *static_cast<const LauvSupervisor::Param*>(t.parameters.data());
      else if (t.name == "fin_watch")
        fin_watch = *static_cast<const FinWatch::Param*>(t.parameters.data());
  }

  // What another program sent to propeller and fins, which DUNE sends on to its other peers, as the graph's own: once
  // all of one actuation has come.
  void note_command(const messages::MessageRef& message, distributers::Typed<LauvVehicle>& adapter) {
    if (const auto* thruster = message.as<messages::imc::SetThrusterActuation>()) commanded.thruster = thruster->value;
    const auto* fin = message.as<messages::imc::SetServoPosition>();
    if (fin == nullptr) return;
    commanded.fins.at(fin->id) = fin->value;
    if (fin->id + 1 == static_cast<int>(commanded.fins.size()))
      adapter.hand_over<&LauvVehicle::Out::actuation>(commanded, system);
  }

  void run(const std::vector<Packet>& packets) {
    distributers::Typed<LauvVehicle> adapter(vehicle);
    messages::PacketReader reader(LauvVehicle::message_set());
    LauvSupervisor::State state;
    LauvSupervisor::In in;
    LauvSupervisor::Out out;
    FinWatch::State fin_state;
    FinWatch::In fins_in;
    FinWatch::Out fins_out;
    std::size_t next = 0;
    const double begin = packets.front().seconds, end = packets.back().seconds;
    for (std::int64_t k = 0; begin + 0.05 * static_cast<double>(k) <= end; ++k) {
      const double now = begin + 0.05 * static_cast<double>(k);
      for (; next < packets.size() && packets[next].seconds <= now; ++next) {
        REQUIRE(reader.read(packets[next].bytes) == messages::PacketError::none);
        adapter.receive(reader.message());
        note_command(reader.message(), adapter);
      }
      adapter.reach(50ms * k, system);
      adapter.take<&LauvVehicle::In::instruments>(in.instruments);
      adapter.take<&LauvVehicle::In::servos>(fins_in.servos);
      const Tick tick{50ms * k, k, 50ms};
      FinWatch::run(fin_watch, tick, fins_in, fin_state, fins_out);
      in.fins = fins_out.fins;
      LauvSupervisor::run(supervisor, tick, in, state, out);
      servos.push_back(fins_in.servos);
      fins.push_back(in.fins);
      seen.push_back(in.instruments);
      if (out.condition.alarm != Alarm::none && alarms.insert(out.condition.alarm).second) alarmed_at = now;
    }
  }

  distributers::LauvVehicleParameters vehicle;
  LauvSupervisor::Param supervisor;
  FinWatch::Param fin_watch;
  tasks::Actuation commanded;
  Nowhere system;
  std::vector<Instruments> seen;
  std::vector<tasks::Servos> servos;
  std::vector<tasks::FinCondition> fins;
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

  TEST_CASE("in a dive of DUNE its fins and its propeller are checked from begin to end, and each follows") {
    Watched dive("dune");
    const auto packets = packets_of("tests/data/dune-dive.packets");
    dive.run(packets);
    CHECK(dive.alarms.empty());
    const tasks::Servos& last = dive.servos.back();
    for (const auto& servo : last.fins) CHECK(servo.count == 799);
    CHECK(last.propeller.count == 800);
    std::array<double, 4> furthest{};
    double fastest = 0, max_thrust = 0;
    for (std::size_t k = 0; k < dive.servos.size(); ++k) {
      CAPTURE(k);
      for (std::size_t i = 0; i < furthest.size(); ++i) {
        CHECK(dive.fins[k].states[i] == (k > 0 ? FinState::follows : FinState::unknown));
        furthest[i] = std::max(furthest[i], std::abs(dive.servos[k].fins[i].angle));
      }
      // for 2 s it may steer itself, as it has not said whether it does
      CHECK(dive.fins[k].propeller == (k > 40 ? FinState::follows : FinState::unknown));
      fastest = std::max(fastest, dive.servos[k].propeller.speed);
      max_thrust = std::max(max_thrust, dive.servos[k].propeller.commanded);
    }
    // it has gone through all that they can do; the rudders had nothing to do
    CHECK(furthest[1] == doctest::Approx(25 * degree).scale(0).epsilon(1e-6));
    CHECK(furthest[2] == furthest[1]);
    CHECK(furthest[0] < 0.01 * degree);
    CHECK(fastest == 2459);
    CHECK(max_thrust == 1);
  }

  TEST_CASE("labels by EntityInfo alone, or by EntityList alone, are as good as both, and nobody is asked for any") {
    for (const bool by_list : {false, true}) {
      CAPTURE(by_list);
      Watched leak("dune");
      auto packets = packets_of("tests/data/dune-leak.packets", 15);
      const std::size_t all = packets.size();
      std::erase_if(packets, [&](const Packet& packet) {
        messages::PacketReader reader(LauvVehicle::message_set());
        reader.read(packet.bytes);
        const auto* list = reader.message().as<messages::imc::EntityList>();
        return by_list ? reader.message().as<messages::imc::EntityInfo>() != nullptr : list != nullptr;
      });
      CHECK(packets.size() < all);
      leak.run(packets);
      CHECK(leak.system.asked == 0);
      CHECK(leak.alarms == std::set<Alarm>{Alarm::leak});
      CHECK(leak.seen.back().leak.value == 1);
      CHECK(leak.seen.back().leak1.value == 1);
    }
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

// A simulated vehicle that a program serves over a link: what jarol vehicle --link does.
#include <doctest/doctest.h>
#include <jarol/serve_vehicle.h>
#include <jarol/tools/library/built_in.h>

#include <atomic>
#include <string>
#include <vector>

using namespace std::chrono_literals;

namespace {
struct Depths : jarol::VehicleSink {
  void add(const jarol::VehicleMoment& moment) override { depths.push_back(moment.vehicle.state().z); }
  std::vector<double> depths;
};

// Ends it after some steps.
struct Ending : jarol::VehicleSink {
  void add(const jarol::VehicleMoment& moment) override { ended = moment.instant >= 100ms; }
  std::atomic<bool> ended{false};
};

// What messages list that a vehicle can have in real time.
std::string links_in_real_time() {
  std::vector<std::string> names;
  for (const auto& link : jarol::built_in().links.entries())
    if (link.make_link) names.push_back(link.name);
  return jarol::list_of(names);
}
}  // namespace

TEST_CASE("a submarine that nobody steers rises from 4 m, and its silence is known") {
  Depths seen;
  std::string at;
  const jarol::ServeOutcome outcome =
      jarol::serve_vehicle("submarine", "{type: udp, listen: 0}", {.initial = "z=4"},
                           {.end = 700ms, .sinks = {&seen}, .on_connected = [&](const jarol::distributers::Link& link) {
                              at = link.transport().text();
                            }});
  CHECK(outcome.simulated == 700ms);
  CHECK(outcome.failure == "");
  CHECK(!outcome.mishap);
  CHECK(outcome.link.heard == 0);
  CHECK(at == outcome.link.link);
  REQUIRE(seen.depths.size() > 2);
  CHECK(seen.depths.front() == 4);
  CHECK(seen.depths.back() < 4);
  CHECK(seen.depths.back() == outcome.state.z);
  CHECK(outcome.silences.silences() == 1);
  CHECK(outcome.silences.silent_for() == 700ms);
  REQUIRE(outcome.silences.kept().size() == 1);
  CHECK(outcome.silences.kept()[0].from == 0ms);
  CHECK(outcome.silences.kept()[0].to == 700ms);
  CHECK(outcome.silences.kept()[0].state.z == outcome.state.z);
  CHECK(outcome.silences.kept()[0].actuators == outcome.actuators);
}

TEST_CASE("it is served until somebody interrupts it") {
  Ending ending;
  const jarol::ServeOutcome outcome = jarol::serve_vehicle("helicopter", "{type: udp, listen: 0}", {},
                                                           {.sinks = {&ending}, .interrupted = &ending.ended});
  CHECK(outcome.simulated >= 100ms);
  CHECK(outcome.simulated < 200ms);
}

TEST_CASE("what is wrong with a vehicle and its link is reported at once") {
  CHECK_THROWS_WITH_AS(jarol::serve_vehicle("submarin", "{type: udp, listen: 0}"),
                       ("there is no vehicle 'submarin'; did you mean 'submarine'?; this build has: " +
                        jarol::list_of(jarol::built_in().vehicles.names()))
                           .c_str(),
                       jarol::InputError);
  CHECK_THROWS_WITH_AS(
      jarol::serve_vehicle("submarine", "{type: udp, listn: 0}", {.set = {"sea.densty=1025"}}),
      ".set:1:1: error: vehicle 'submarine' parameter 'sea' has no field 'densty'; did you mean 'density'?; it has: "
      "gravity, density, temperature, salinity, current_north, current_east, wave_height, wave_period, wave_direction, "
      "floor, latitude, longitude, beacons\n  sea.densty=1025\n  ^\n"
      "the link:1:13: error: the link has no key 'listn'; did you mean 'listen'?; it has: type, listen, peer, peers, "
      "announce, silence, key, id, source, port\n  {type: udp, listn: 0}\n              ^",
      jarol::SpecError);
  CHECK_THROWS_WITH_AS(jarol::serve_vehicle("submarine", "{type: lockstep, peer: 7010}", {.initial = "z"}),
                       (".initial:1:1: error: 'z' sets nothing; write name=value, as in z=4,theta=0.1\n  z\n  ^\n"
                        "the link:1:8: error: the link has type 'lockstep'; a vehicle in real time can have: " +
                        links_in_real_time() + "\n  {type: lockstep, peer: 7010}\n         ^")
                           .c_str(),
                       jarol::SpecError);
  CHECK_THROWS_WITH_AS(jarol::serve_vehicle("submarine", "{listen: 6002}"),
                       ("the link:1:1: error: the link lacks the key 'type'; a vehicle in real time can have: " +
                        links_in_real_time() + "\n  {listen: 6002}\n  ^")
                           .c_str(),
                       jarol::SpecError);
  CHECK_THROWS_WITH_AS(
      jarol::serve_vehicle("helicopter", "{type: udp, listen: 0}", {}, {.telemetry = jarol::Telemetry::true_state}),
      "there is no message of a helicopter's true state", jarol::InputError);
}

#include "vehicles/submarine/sensors.h"

#include <doctest/doctest.h>

#include <map>
#include <string>

#include "distributers/messages/imc.h"
#include "distributers/messages/payload.h"
#include "graph/math/geometry.h"
#include "vehicles/sea/sea_water.h"
#include "vehicles/submarine/submarine.h"

namespace {
using namespace jarol::vehicles;
namespace messages = jarol::messages;
namespace imc = messages::imc;
using namespace std::chrono_literals;

// How often each message came, and the last of some.
struct Reported : messages::Receiver {
  void receive(messages::MessageRef message) override {
    ++counts[std::string(message.descriptor->name)];
    if (const auto* m = message.as<imc::Depth>()) depth = *m;
    if (const auto* m = message.as<imc::GpsFix>()) fix = *m;
    if (const auto* m = message.as<imc::EntityState>()) leak = m->state;
    if (const auto* m = message.as<imc::Acceleration>()) force = *m;
  }
  std::map<std::string, int> counts;
  imc::Depth depth;
  imc::GpsFix fix;
  imc::Acceleration force;
  int leak = -1;
};

const SubmarineReadings& readings_of(const Submarine& submarine) {
  return static_cast<const SubmarineOutputs*>(submarine.outputs())->sensors;
}

Submarine deep(const SubmarineParameters& from = {}, std::uint64_t seed = 0) {
  SubmarineParameters parameters = from;
  parameters.start.depth = 20;
  parameters.hull.buoyancy = parameters.hull.mass * parameters.sea.gravity;
  return Submarine(parameters, seed);
}
}  // namespace

TEST_SUITE("vehicles/submarine_sensors") {
  TEST_CASE("a fix to the east of the date line has a longitude to the west") {
    SubmarineParameters parameters;
    parameters.sea.longitude = jarol::pi;
    parameters.start.east = 60;
    Reported reported;
    Submarine(parameters, 0).sense(reported);
    CHECK(reported.fix.lon == doctest::Approx(60 / jarol::earth_radii(parameters.sea.latitude).east - jarol::pi));
  }

  TEST_CASE("at rest in the deep each reports what there is") {
    Submarine submarine = deep();
    const double z = submarine.state().z;
    for (int i = 0; i < 100; ++i) submarine.step();
    const SubmarineReadings& r = readings_of(submarine);
    CHECK(r.depth == doctest::Approx(z));
    CHECK(r.pressure == doctest::Approx(1013.25 + 98.1 * z));
    CHECK(r.water_temperature == 14);
    CHECK(r.salinity == doctest::Approx(35).scale(0).epsilon(1e-9));
    CHECK(r.sound_speed == doctest::Approx(calc_sound_speed(14, 35, z)));
    CHECK(r.theta == doctest::Approx(0));
    CHECK(r.f_z == doctest::Approx(-9.81));
    CHECK(std::abs(r.f_x) < 1e-9);
    CHECK(r.altitude == doctest::Approx(50 - z));
    CHECK(r.rpm == 0);
    CHECK(std::isnan(r.gps_north));
    CHECK(r.leak == 0);
    CHECK(r.current == 1);
    CHECK(r.voltage == doctest::Approx(25.1).scale(0).epsilon(1e-4));
  }

  TEST_CASE("the sea water of 15 degrees and salinity 35 conducts and sounds as the tables say") {
    CHECK(calc_conductivity(15, 35) == doctest::Approx(4.2914).scale(0).epsilon(1e-4));
    // check value of UNESCO technical paper 44: R = 1.2, t = 20 degC, 2000 dbar is S = 37.245628; R_p = 1.0169430
    CHECK(calc_salinity(1.2 / 1.0169430 * 4.2914, 20) == doctest::Approx(37.245628).scale(0).epsilon(1e-6));
    CHECK(calc_sound_speed(15, 35, 0) == doctest::Approx(1506.7).scale(0).epsilon(1e-3));
  }

  TEST_CASE("sound is as fast as Mackenzie says, too") {
    // "Nine-term equation for sound speed in the oceans", 1981: within the 0.5 m/s that the simple one is good for
    const auto mackenzie = [](double t, double S, double D) {
      return 1448.96 + 4.591 * t - 5.304e-2 * t * t + 2.374e-4 * t * t * t + 1.340 * (S - 35) + 1.630e-2 * D +
             1.675e-7 * D * D - 1.025e-2 * t * (S - 35) - 7.139e-13 * t * D * D * D;
    };
    for (const double t : {2.0, 10.0, 20.0, 30.0})
      for (const double S : {30.0, 35.0, 40.0})
        for (const double D : {0.0, 100.0, 500.0, 1000.0})
          CHECK(std::abs(calc_sound_speed(t, S, D) - mackenzie(t, S, D)) < 0.6);
  }

  TEST_CASE("each speaks at its rate, GPS only where the antenna is out of the water") {
    Submarine afloat({}), dived = deep();
    Reported from_afloat, from_dived;
    for (int i = 0; i < 1000; ++i) {
      afloat.step();
      afloat.sense(from_afloat);
      dived.step();
      dived.sense(from_dived);
    }
    CHECK(from_afloat.counts == std::map<std::string, int>{{"Acceleration", 1000},   {"AngularVelocity", 1000},
                                                           {"Conductivity", 62},     {"Current", 10},
                                                           {"Depth", 100},           {"Distance", 100},
                                                           {"EntityList", 10},       {"EntityState", 40},
                                                           {"EulerAngles", 1000},    {"GpsFix", 10},
                                                           {"LblConfig", 1},         {"LblRange", 10},
                                                           {"Pressure", 100},        {"Rpm", 200},
                                                           {"Salinity", 62},         {"ServoPosition", 4000},
                                                           {"SimulatedState", 1000}, {"SoundSpeed", 62},
                                                           {"Temperature", 102},     {"VehicleState", 10},
                                                           {"Voltage", 10},          {"WaterVelocity", 100}});
    CHECK(from_dived.counts.count("GpsFix") == 0);
    CHECK(from_dived.counts["Depth"] == 100);
  }

  TEST_CASE("a fix lies where the vehicle is") {
    SubmarineParameters parameters;
    parameters.start.north = 1000;
    parameters.start.east = -500;
    Reported reported;
    Submarine(parameters).sense(reported);
    // 1000 m along the meridian at 41.2 degrees and 500 m along the parallel, WGS-84
    CHECK((reported.fix.lat - parameters.sea.latitude) * 6362985 == doctest::Approx(1000).scale(0).epsilon(1e-3));
    CHECK((reported.fix.lon - parameters.sea.longitude) * 6387000 * std::cos(parameters.sea.latitude) ==
          doctest::Approx(-500).scale(0).epsilon(1e-3));
  }

  TEST_CASE("a leak is reported from when it begins") {
    SubmarineParameters parameters;
    parameters.leak_at = 2s;
    Submarine submarine(parameters);
    Reported reported;
    for (int i = 0; i < 150; ++i) submarine.step();
    for (int i = 0; i < 20; ++i) submarine.step(), submarine.sense(reported);
    CHECK(reported.counts.count("EntityState") == 0);
    for (int i = 0; i < 100; ++i) submarine.step(), submarine.sense(reported);
    CHECK(reported.leak == imc::EntityState::State::FAILURE);
  }

  TEST_CASE("the speed log measures through the water that the waves move") {
    SubmarineParameters parameters;
    parameters.sea.wave_height = 1;
    parameters.sea.wave_period = 6;
    parameters.sensors.speed_log.period = 10ms;
    Submarine submarine(parameters);
    double max = 0;
    for (int i = 0; i < 600; ++i) {
      submarine.step();
      max = std::max(max, std::abs(readings_of(submarine).u - submarine.state().u));
    }
    // orbital speed pi H / T
    CHECK(max == doctest::Approx(3.1416 / 6).scale(0).epsilon(0.15));
  }

  TEST_CASE("noise of one sensor changes no other, and another seed changes what is reported") {
    SubmarineParameters noisy;
    noisy.sensors.depth.noise = 0.1;
    Submarine one = deep(noisy, 1), again = deep(noisy, 1), two = deep(noisy, 2), plain = deep({}, 1);
    for (int i = 0; i < 50; ++i)
      for (Submarine* each : {&one, &again, &two, &plain}) each->step();
    CHECK(readings_of(one).depth == readings_of(again).depth);
    CHECK(readings_of(one).depth != readings_of(two).depth);
    CHECK(readings_of(one).pressure == readings_of(plain).pressure);
    CHECK(one.state().z == plain.state().z);
  }

  TEST_CASE("propulsion draws current, the voltage sags and the hull warms up") {
    Submarine submarine = deep();
    SubmarineInputs inputs;
    inputs.thruster = 1;
    for (int i = 0; i < 6000; ++i) {
      submarine.command(&inputs);
      submarine.step();
    }
    const SubmarineReadings& r = readings_of(submarine);
    CHECK(r.current == doctest::Approx(7).scale(0).epsilon(1e-3));
    // a minute at 7 A of 20 A h
    CHECK(r.voltage == doctest::Approx(25.2 - 0.7 - 7.2 * 7 / 60 / 20).scale(0).epsilon(1e-4));
    CHECK(r.hull_temperature == doctest::Approx(14 + 21 * (1 - std::exp(-0.1))).scale(0).epsilon(0.01));
  }

  TEST_CASE("each transponder within reach answers every two seconds, and where they lie is reported every ten") {
    SubmarineParameters parameters;
    parameters.sea.beacons.first = {30, 40, 60};
    parameters.sea.beacons.second = {0, 400, 20};
    parameters.sea.beacons.reach = 100;
    parameters.sea.current_north = 0.5;
    Submarine submarine = deep(parameters);
    struct Heard : messages::Receiver {
      void receive(messages::MessageRef message) override {
        if (const auto* m = message.as<imc::LblRange>()) ranges.push_back(*m);
        if (const auto* m = message.as<imc::LblConfig>()) configs.push_back(*m);
      }
      std::vector<imc::LblRange> ranges;
      std::vector<imc::LblConfig> configs;
    } heard;
    submarine.sense(heard);
    double depth = 0;  // at the last range
    for (int i = 0; i < 1999; ++i) {
      const std::size_t before = heard.ranges.size();
      submarine.step();
      submarine.sense(heard);
      if (heard.ranges.size() > before) depth = submarine.state().z;
    }
    REQUIRE(heard.ranges.size() == 10);
    const auto& last = heard.ranges.back();  // at 18 s, 9 m to the north
    CHECK(last.id == 0);
    CHECK(last.range == doctest::Approx(std::hypot(30 - 9, 40, 60 - depth)).scale(0).epsilon(1e-3));
    CHECK(readings_of(submarine).range_first == doctest::Approx(static_cast<double>(last.range)));
    CHECK(std::isnan(readings_of(submarine).range_second));
    REQUIRE(heard.configs.size() == 2);
    CHECK(heard.configs[0].op == imc::LblConfig::Op::CUR_CFG);
    REQUIRE(heard.configs[0].beacons.size() == 2);
    messages::Message message;
    REQUIRE(messages::take_inline(imc::message_set(), heard.configs[0].beacons[1], message));
    const auto* second = message.as<imc::LblBeacon>();
    REQUIRE(second != nullptr);
    CHECK(second->beacon.view() == "second");
    CHECK(second->depth == 20);
    CHECK(second->lat == parameters.sea.latitude);
    // the radius of that parallel is 4807.09 km
    CHECK(second->lon - parameters.sea.longitude == doctest::Approx(400 / 4.80709e6).scale(0).epsilon(1e-5));
  }

  TEST_CASE("without transponders nothing is told of them") {
    SubmarineParameters parameters;
    parameters.sea.beacons.reach = 0;
    Submarine submarine = deep(parameters);
    Reported reported;
    submarine.sense(reported);
    for (int i = 0; i < 1000; ++i) {
      submarine.step();
      submarine.sense(reported);
    }
    CHECK(reported.counts["LblRange"] == 0);
    CHECK(reported.counts["LblConfig"] == 0);
  }
}

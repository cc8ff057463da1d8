// The vehicle files against recordings of DUNE's simulator VSIM, and against the steady states read off it.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <sstream>
#include <vector>

#include "distributers/interfaces/vehicle_file.h"
#include "graph/values/bind.h"
#include "tests/tools/csv_rows.h"
#include "tests/tools/run_command.h"
#include "tools/library/built_in.h"
#include "vehicles/submarine/submarine.h"

namespace {
using namespace jarol;
using namespace jarol::vehicles;
using command::TemporaryFolder;

constexpr double degrees = std::numbers::pi / 180;

// Drives the file's submarine by the recorded commands and compares at each recorded instant.
void check_follows(const std::string& recording, const std::string& initial, double most) {
  const TemporaryFolder folder;
  const std::string data = "tests/data/lauv-" + recording;
  const auto run = command::run_jarol("vehicle submarine --parameters specs/vehicles/submarine_vsim.yaml --initial " +
                                      initial + " --script " + data + "-commands.csv --csv " + folder / "out.csv");
  REQUIRE(run.output == "");
  const auto out = command::rows_of(folder / "out.csv"), recorded = command::rows_of(data + "-motion.csv");
  double distance = 0, turned = 0;
  std::size_t i = 0, compared = 0;
  for (const auto& row : recorded) {
    while (i < out.size() && out[i][0] < row[0] - 1e-6) ++i;
    REQUIRE(i < out.size());
    distance = std::max(distance, std::hypot(out[i][1] - row[1], out[i][2] - row[2], out[i][3] - row[3]));
    turned = std::max(turned, std::abs(std::remainder(out[i][6] - row[4], 2 * std::numbers::pi)));
    ++compared;
  }
  MESSAGE(recording << ": " << compared << " instants, within " << distance << " m and " << turned / degrees << " deg");
  CHECK(compared > 470);
  CHECK(distance < most);
  CHECK(turned < 0.1 * degrees);
}

SubmarineParameters parameters_of(const std::string& path) {
  Problems problems;
  const auto file = distributers::read_vehicle_file(read_source(path), built_in().vehicles, problems);
  problems.throw_if_any();
  return *static_cast<const SubmarineParameters*>(file->parameters.data());
}

// A random binary sequence: rudders by 10 degrees to one side or the other for a second each, after 20 s ahead. Its
// switches come late by so much: the one of that number, or all.
std::vector<std::array<double, 3>> places_of_random_turns(double late, std::optional<std::size_t> only) {
  const TemporaryFolder folder;
  std::ostringstream script;
  script << "time,thruster,fin0,fin1,fin2,fin3\n0,0.5,0,0,0,0\n";
  std::mt19937_64 random(1);
  double fins = 0;
  std::size_t switches = 0;
  for (std::size_t i = 0; i < 80; ++i) {
    const double next = (random() & 1) == 0 ? 10 * degrees : -10 * degrees;
    const bool is_late = next != fins && (!only || *only == ++switches);
    script << 20 + static_cast<double>(i) + (is_late ? late : 0.0) << ",," << next << ",,," << next << '\n';
    fins = next;
  }
  script << "100,,,,,\n";
  const auto run = command::run_jarol("vehicle submarine --parameters specs/vehicles/submarine_vsim.yaml --script " +
                                      folder.write("turns.csv", script.str()) + " --csv " + folder / "out.csv");
  REQUIRE(run.output == "");
  std::vector<std::array<double, 3>> places;
  for (const auto& row : command::rows_of(folder / "out.csv")) places.push_back({row[1], row[2], row[3]});
  return places;
}

double greatest_distance(const std::vector<std::array<double, 3>>& a, const std::vector<std::array<double, 3>>& b) {
  REQUIRE(a.size() == b.size());
  double greatest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    greatest = std::max(greatest, std::hypot(a[i][0] - b[i][0], a[i][1] - b[i][1], a[i][2] - b[i][2]));
  return greatest;
}

// Where a minute of these commands leads in the deep, without surplus of buoyancy.
VehicleState steady(SubmarineParameters parameters, double thruster, double rudders) {
  parameters.hull.buoyancy = parameters.hull.mass * parameters.sea.gravity;
  parameters.start.depth = 20;
  parameters.start.surge = 1;
  Submarine submarine(parameters);
  const SubmarineInputs inputs{thruster, rudders, 0, 0, rudders};
  submarine.command(&inputs);
  for (int i = 0; i < 6000; ++i) submarine.step();
  return submarine.state();
}

struct Turn {
  double rudders, r, u, v;
};
// with both rudders at these angles, actuation 0.5
constexpr Turn turns[] = {
    {-5 * degrees, 0.304, 1.506, -0.242}, {10 * degrees, -0.381, 1.329, 0.301}, {20 * degrees, -0.451, 1.107, 0.355}};
}  // namespace

TEST_SUITE("tools/submarine_recordings") {
  TEST_CASE("submarine_vsim.yaml stays within 2 cm and 0.1 degrees of the recordings at every instant") {
    check_follows("surge", "x=0.08787671,z=0.2223941,theta=-0.03265889,u=0.02326914,w=-0.04943845,q=0.02191746", 0.005);
    check_follows("yaw", "x=0.08812543,z=0.2219075,theta=-0.03243972,u=0.02326187,w=-0.04953871,q=0.021909", 0.02);
  }

  TEST_CASE("it stays within 4 cm of one in which the simulator's servos were late by two steps, once") {
    check_follows("pitch", "x=0.08812543,z=0.2219075,theta=-0.03243972,u=0.02326187,w=-0.04953871,q=0.021909", 0.04);
  }

  // Why a random binary sequence is the run that a model follows worst: its heading is wrong from then on.
  TEST_CASE("a switch of a random sequence of fins that is two steps late leads astray by 0.3 to 1.5 m, all by 6 cm") {
    const auto in_time = places_of_random_turns(0, {});
    CHECK(greatest_distance(in_time, places_of_random_turns(0.02, {})) < 0.065);
    for (const std::size_t only : {1, 9, 21, 33}) {
      CAPTURE(only);
      const double astray = greatest_distance(in_time, places_of_random_turns(0.02, only));
      CHECK(astray > 0.3);
      CHECK(astray < 1.5);
    }
  }

  TEST_CASE("speeds ahead are those read off the simulator, within 1 %, in its own physics and in right physics") {
    for (const std::string file : {"specs/vehicles/submarine_vsim.yaml", "specs/vehicles/submarine_dune.yaml"}) {
      CAPTURE(file);
      const SubmarineParameters parameters = parameters_of(file);
      for (const auto& [actuation, u] :
           {std::pair{0.2, 0.610}, {0.3, 0.9245}, {0.4, 1.238}, {0.5, 1.551}, {0.7, 1.791}, {1.0, 1.791}})
        CHECK(steady(parameters, actuation, 0).u == doctest::Approx(u).scale(0).epsilon(0.01));
    }
  }

  TEST_CASE("turns are those read off the simulator, within 1 %") {
    const SubmarineParameters parameters = parameters_of("specs/vehicles/submarine_vsim.yaml");
    for (const Turn& turn : turns) {
      const VehicleState state = steady(parameters, 0.5, turn.rudders);
      CHECK(state.r == doctest::Approx(turn.r).scale(0).epsilon(0.01));
      CHECK(state.u == doctest::Approx(turn.u).scale(0).epsilon(0.01));
      CHECK(state.v == doctest::Approx(turn.v).scale(0).epsilon(0.01));
      CHECK(std::abs(std::abs(state.phi) - 0.05) < 0.01);
    }
  }

  TEST_CASE("in right physics, where fins lift by the speed ahead alone, turns are within 3 %") {
    const SubmarineParameters parameters = parameters_of("specs/vehicles/submarine_dune.yaml");
    for (const Turn& turn : turns) {
      const VehicleState state = steady(parameters, 0.5, turn.rudders);
      CHECK(state.r == doctest::Approx(turn.r).scale(0).epsilon(0.03));
      CHECK(state.u == doctest::Approx(turn.u).scale(0).epsilon(0.03));
    }
  }

  TEST_CASE("with vsim_compatible it floats at rest where the simulator does") {
    Submarine submarine(parameters_of("specs/vehicles/submarine_vsim.yaml"));
    for (int i = 0; i < 12000; ++i) submarine.step();
    CHECK(submarine.state().z == doctest::Approx(0.0541).scale(0).epsilon(0.001));
  }

  TEST_CASE(
      "submarine_vsim.yaml and submarine_dune.yaml differ in physics, in the hull's shape and in what fins roll") {
    SubmarineParameters vsim = parameters_of("specs/vehicles/submarine_vsim.yaml");
    const SubmarineParameters dune = parameters_of("specs/vehicles/submarine_dune.yaml");
    CHECK(vsim.vsim_compatible);
    CHECK(!dune.vsim_compatible);
    vsim.vsim_compatible = false;
    CHECK(dune.hull.length < vsim.hull.length);
    vsim.hull.length = dune.hull.length;
    vsim.hull.diameter = dune.hull.diameter;
    CHECK(dune.fins.radius == 0);
    vsim.fins.radius = 0;
    const Type& type = type_of<SubmarineParameters>();
    CHECK(type.hash_words(&vsim) == type.hash_words(&dune));
  }

  TEST_CASE("submarine.yaml is the default, number by number") {
    const SubmarineParameters file = parameters_of("specs/vehicles/submarine.yaml"), made;
    for (const Leaf& leaf : leaves_of(type_of<SubmarineParameters>())) {
      const auto text = [&](const SubmarineParameters& of) {
        return scalar_text(*leaf.type, reinterpret_cast<const std::byte*>(&of) + leaf.offset);
      };
      CAPTURE(leaf.path);
      CHECK(std::string(text(file)) == text(made));
    }
  }
}

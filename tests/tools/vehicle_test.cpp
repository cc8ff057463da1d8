// `jarol vehicle`: a vehicle alone, described or driven by a script.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "tests/tools/csv_rows.h"
#include "tests/tools/run_command.h"

namespace {
using command::run_jarol;
using command::TemporaryFolder;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> lines_of_file(const std::string& path) {
  std::ifstream file(path);
  return lines_of({std::istreambuf_iterator<char>(file), {}});
}

const std::string title = "time,x,y,z,phi,theta,psi,u,v,w,p,q,r";

// What drives it wrongly is reported, and no file appears.
void check_refused(const std::string& script, const std::string& options, const std::string& message) {
  const TemporaryFolder folder;
  const auto path = folder.write("script.csv", script);
  auto refused = run_jarol("vehicle submarine --script " + path + " --csv " + folder / "out.csv" + " " + options);
  CHECK(refused.exit_code == 2);
  for (std::size_t at = 0; (at = refused.output.find(path)) != std::string::npos;)
    refused.output.replace(at, path.size(), "FILE");
  CHECK(refused.output == message);
  CHECK(!std::filesystem::exists(folder / "out.csv"));
}
}  // namespace

TEST_SUITE("tools/vehicle") {
  TEST_CASE("a vehicle that capsizes ends with 1, driven by a script as by a peer") {
    const TemporaryFolder folder;
    const auto script = folder.write("script.csv", "time,thruster\n0,0\n0.1,0\n");
    const std::string over = "vehicle submarine --set hull.z_g=-0.01 --initial phi=100deg ",
                      line = "error: the submarine has capsized: tilted by 100 deg, beyond 90 deg, at 0.01 s\n";
    const auto driven = run_jarol(over + "--script " + script + " --csv " + folder / "out.csv");
    CHECK(driven.output == line);
    CHECK(driven.exit_code == 1);
    const auto served = run_jarol(over + "--link udp --listen 0 --for 50ms", "2>&1 >/dev/null");
    CHECK(served.output.ends_with(line));
    CHECK(served.exit_code == 1);
  }

  TEST_CASE("it writes time, state and outputs from the row at time 0 to the last row of the script") {
    const TemporaryFolder folder;
    const auto script = folder.write(
        "script.csv", "time,thruster,fin0,fin1,fin2,fin3\n0,0.5,0,0,0,0\n2,0.5,0.1,0,0,0.1\n4,0,0,0,0,0\n");
    const auto run = run_jarol("vehicle submarine --initial z=4,theta=0.1,psi=90deg --script " + script + " --csv " +
                               folder / "out.csv");
    CHECK(run.output == "");
    CHECK(run.exit_code == 0);
    const auto lines = lines_of_file(folder / "out.csv");
    REQUIRE(lines.size() == 402);
    CHECK(lines[0].substr(0, title.size() + 1) == title + ",");
    const auto rows = command::rows_of(folder / "out.csv");
    const auto &first = rows.front(), &last = rows.back();
    CHECK(first[0] == 0);
    CHECK(first[3] == 4);
    CHECK(first[5] == doctest::Approx(0.1));
    CHECK(first[6] == doctest::Approx(1.5707963267948966));
    CHECK(last[0] == 4);
    CHECK(last[2] > 1);       // it went east
    CHECK(last[6] < 1.5707);  // and turned to port
  }

  TEST_CASE("--rate thins the rows and changes none of them") {
    const TemporaryFolder folder;
    const auto script = folder.write("script.csv", "time,thruster,fin1\n0,0.5,0\n0.105,1,0.2\n1,0,0\n");
    CHECK(run_jarol("vehicle submarine --script " + script + " --csv " + folder / "all.csv").exit_code == 0);
    CHECK(run_jarol("vehicle submarine --rate 20 --script " + script + " --csv " + folder / "some.csv").exit_code == 0);
    const auto all = lines_of_file(folder / "all.csv"), some = lines_of_file(folder / "some.csv");
    REQUIRE(all.size() == 102);
    REQUIRE(some.size() == 22);
    for (std::size_t i = 0; i <= 20; ++i) CHECK(some[1 + i] == all[1 + 5 * i]);
  }

  TEST_CASE("a row holds until the next, an empty cell keeps what was, a column that is missing is at rest") {
    const TemporaryFolder folder;
    const auto brief = folder.write("brief.csv", "time,fin0,thruster\n0,0.1,0.5\n20,,0.2\n25,,\n");
    std::string text = "time,thruster,fin0,fin1,fin2,fin3\n";
    for (int i = 0; i < 200; ++i) text += std::to_string(i) + "e-1,0.5,0.1,0,0,0\n";
    for (int i = 200; i <= 250; ++i) text += std::to_string(i) + "e-1,0.2,0.1,0,0,0\n";
    const auto full = folder.write("full.csv", text);
    CHECK(run_jarol("vehicle submarine --script " + brief + " --csv " + folder / "brief_out.csv").exit_code == 0);
    CHECK(run_jarol("vehicle submarine --script " + full + " --csv " + folder / "full_out.csv").exit_code == 0);
    CHECK(lines_of_file(folder / "brief_out.csv") == lines_of_file(folder / "full_out.csv"));
  }

  TEST_CASE("--for goes on after the last row") {
    const TemporaryFolder folder;
    const auto script = folder.write("script.csv", "time,thruster\n0,0.5\n");
    CHECK(run_jarol("vehicle submarine --for 3s --script " + script + " --csv " + folder / "out.csv").exit_code == 0);
    CHECK(lines_of_file(folder / "out.csv").size() == 302);
  }

  TEST_CASE("what is wrong with a script is reported at its place") {
    check_refused("time,thruster,fin9\n0,0.5,0\n", "",
                  "FILE:1:15: error: column 'fin9' is no input of vehicle 'submarine'; did you mean 'fin0'?; there "
                  "are: thruster, fin0, fin1, fin2, fin3\n  time,thruster,fin9\n                ^\n1 error\n");
    check_refused("time,thruster\n0,1.5\n", "",
                  "FILE:2:3: error: column 'thruster': '1.5' is not between -1 and 1\n  0,1.5\n    ^\n1 error\n");
    check_refused("time,thruster\n0,nan\n", "",
                  "FILE:2:3: error: column 'thruster': 'nan' is not a number\n  0,nan\n    ^\n1 error\n");
    check_refused("time,fin0,fin0\n0,0,0\n", "",
                  "FILE:1:11: error: column 'fin0' stands there twice\n  time,fin0,fin0\n            ^\n1 error\n");
    check_refused(
        "thruster,time\n0,0\n", "",
        "FILE:1:1: error: the first column is 'thruster'; it has to be 'time'\n  thruster,time\n  ^\n"
        "FILE:1:10: error: column 'time' is no input of vehicle 'submarine'; there are: thruster, fin0, fin1, "
        "fin2, fin3\n  thruster,time\n           ^\n2 errors\n");
  }

  TEST_CASE("what is wrong with the options is reported") {
    const std::string script = "time,thruster\n0,0\n";
    check_refused(script, "--initial z=4,foo=1",
                  "--initial:1:5: error: the state has no 'foo'; it has: x, y, z, phi, theta, psi, u, v, w, p, q, r\n"
                  "  z=4,foo=1\n      ^\n1 error\n");
    check_refused(
        script, "--set hull.mas=3",
        "--set:1:1: error: vehicle 'submarine' parameter 'hull' has no field 'mas'; did you mean 'mass'?; it "
        "has: length, diameter, mass, buoyancy, water_density, z_g, I_x, I_y, I_z\n  hull.mas=3\n  ^\n1 error\n");
    check_refused(script, "--set hull.mass=-3",
                  "error: vehicle 'submarine' can't be made: submarine: hull.mass must be above zero\n");
    check_refused(script, "--rate 30",
                  "error: --rate: 30 rows per second do not fall on the vehicle's steps of 10ms; it can be 100 divided "
                  "by a whole number\n");
    check_refused(
        script, "--for 10s --rate 0.01",
        "error: --rate: 0.01 rows per second are one in 100s, and it is driven for 10s; choose more, or leave "
        "it out for 100\n");
    check_refused(
        script, "--for 10s --rate 1e-300",
        "error: --rate: 1e-300 rows per second are one in 1000000000s, and it is driven for 10s; choose more, "
        "or leave it out for 100\n");
    check_refused(script, "--for 3",
                  "error: --for: '3' has no unit; write one of h, min, s, ms, us or ns, as in 10ms\n");
    const auto unknown = run_jarol("vehicle submarin --describe");
    CHECK(unknown.exit_code == 2);
    CHECK(unknown.output.rfind("error: there is no vehicle 'submarin'; did you mean 'submarine'?; this build has: ",
                               0) == 0);
    const auto idle = run_jarol("vehicle submarine");
    CHECK(idle.exit_code == 2);
    CHECK(idle.output ==
          "error: say --describe; or --script and --csv: what to do, and where the motion goes; or --link: who "
          "steers it\n");
  }

  TEST_CASE("a motion that no number can express ends with exit code 3 and without a file") {
    const TemporaryFolder folder;
    const auto script = folder.write("script.csv", "time,thruster\n0,0\n1,0\n");
    const auto run =
        run_jarol("vehicle submarine --initial u=1e200 --script " + script + " --csv " + folder / "out.csv");
    CHECK(run.exit_code == 3);
    CHECK(run.output.rfind("error: submarine: no state at t = 0.010000 s: ", 0) == 0);
    CHECK(!std::filesystem::exists(folder / "out.csv"));
  }

  TEST_CASE("--describe reports state, inputs, outputs and parameters with their units, as text and as JSON") {
    const auto text = run_jarol("vehicle submarine --describe --set hull.mass=19");
    CHECK(text.exit_code == 0);
    CHECK(text.output.find("\nstate\n  x       [m]      north of the origin\n") != std::string::npos);
    CHECK(text.output.find("\ninputs\n  thruster  -1 to 1 ") != std::string::npos);
    const auto whole =
        nlohmann::json::parse(run_jarol("vehicle submarine --describe --set hull.mass=19 --json").output);
    CHECK(whole["schema"] == "jarol.vehicle/1");
    CHECK(whole["name"] == "submarine");
    CHECK(whole["state"].size() == 12);
    CHECK(whole["inputs"].size() == 5);
    bool found = false;
    for (const auto& parameter : whole["parameters"]) {
      if (parameter["name"] != "hull.mass") continue;
      found = true;
      CHECK(parameter["unit"] == "kg");
      CHECK(parameter["value"] == "19");
    }
    CHECK(found);
  }

  TEST_CASE("the helicopter's sensors are described") {
    const auto described = run_jarol("vehicle helicopter --describe");
    CHECK(described.output.find("\nsensors\n") != std::string::npos);
    CHECK(described.output.find("  sensors.sonar         [m]      range to the ground\n") != std::string::npos);
  }
}

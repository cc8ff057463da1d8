// Which fields a picture shows, and what goes to stdout.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/tools/run_command.h"

namespace {
using command::content;
using command::run_jarol;
using command::TemporaryFolder;
using Titles = std::vector<std::string>;

// Of the panels of a picture, from above.
Titles titles_of(const std::string& svg) {
  Titles titles;
  const std::regex title("<tspan[^>]*>([^<]*)</tspan>");
  for (std::sregex_iterator at(svg.begin(), svg.end(), title), end; at != end; ++at) titles.push_back((*at)[1]);
  return titles;
}

#ifdef JAROL_VEHICLES
std::size_t count_in(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) ++found;
  return found;
}
#endif

const std::string counting = "run specs/counting.yaml --for 100ms ";
}  // namespace

TEST_SUITE("tools/run_files") {
  TEST_CASE("a picture shows the fields that --signals names, in its order, each once") {
    const TemporaryFolder folder;
    const std::string picture = folder / "p.svg";
    CHECK(run_jarol(counting + "--plot " + picture + " --signals 'total,*.out,count.out'").exit_code == 0);
    CHECK(titles_of(content(picture)) == Titles{"total", "add.out", "count.out", "loop.out", "slow.out", "sum.out"});
  }

  TEST_CASE("names that nothing has are refused with those that there are") {
    CHECK(run_jarol(counting + "--plot /dev/null --signals 'total,cuont.out'").output ==
          "error: --signals: nothing that is published has the name 'cuont.out'; did you mean 'count.out'?; there are: "
          "add.out, count.out, loop.out, slow.out, sum.out, total\n");
    CHECK(run_jarol(counting + "--plot /dev/null --signals 'total,,add.out'").output ==
          "error: --signals: 'total,,add.out' has an empty name; write them as in depth.*,fins.*\n");
    CHECK(run_jarol(counting + "--signals total").output ==
          "error: --signals says what --plot draws; add --plot FILE, or leave it out\n");
  }

  TEST_CASE("without commands to show, a picture of what is published first says so") {
    const TemporaryFolder folder;
    const std::string picture = folder / "p.svg";
    CHECK(run_jarol(counting + "--plot " + picture, "2>&1 >/dev/null").output ==
          "note: no 'out' communicator of an operator reports what one of its 'in' communicators commands, so the "
          "picture shows what is published first; name fields by --signals\n");
    CHECK(titles_of(content(picture)) == Titles{"add.out", "count.out", "loop.out", "slow.out", "sum.out", "total"});
  }

  TEST_CASE("a filled trace repeats what was published last, from when it first was") {
    const TemporaryFolder folder;
    const std::string trace = folder / "t.csv", filled = folder / "f.csv";
    CHECK(run_jarol("run specs/counting.yaml --for 20ms --trace " + trace).exit_code == 0);
    CHECK(run_jarol("run specs/counting.yaml --for 20ms --trace-fill --trace " + filled).exit_code == 0);
    CHECK(content(trace) ==
          "time,add.out,count.out,loop.out,slow.out,sum.out,total\n0,,0,,,,0\n0.01,0,1,,,0,\n0.015,,,,0,,\n");
    CHECK(content(filled) ==
          "time,add.out,count.out,loop.out,slow.out,sum.out,total\n0,,0,,,,0\n0.01,0,1,,,0,0\n0.015,0,1,,0,0,0\n");
    CHECK(run_jarol(counting + "--trace-fill").output ==
          "error: --trace-fill is about --trace; add --trace FILE, or leave it out\n");
  }

#ifdef JAROL_VEHICLES
  TEST_CASE(
      "a picture shows what is true beside what is reported, the actuators, names of states, the path and what the run "
      "differs in") {
    const TemporaryFolder folder;
    const std::string picture = folder / "p.svg", recording = folder / "r.mcap", replayed = folder / "q.svg";
    CHECK(run_jarol("run specs/exolauv.yaml --profile at_sea --seed 7 --for 20s --set expect=nothing --record " +
                    recording + " --plot " + picture)
              .exit_code == 0);
    const std::string svg = content(picture);
    CHECK(titles_of(svg) ==
          Titles{"depth", "pitch", "heading", "speed", "alarm", "fins", "to_dune.thruster", "to_dune.fins", "path"});
    const auto count = [&](const std::string& text) { return count_in(svg, text); };
    CHECK(count(">true</text>") == 5);  // all but alarm and fins, and the path
    CHECK(count(">commanded</text>") == 3);
    CHECK(count(">none</text>") == 1);
    for (const std::string fin : {"fins.0", "fins.1", "fins.2", "fins.3"}) CHECK(count(">" + fin + "</text>") == 1);
    CHECK(count(">profile at_sea, seed 7, expect=nothing</text>") == 1);
    CHECK(run_jarol("replay " + recording + " --plot " + replayed).exit_code == 0);
    CHECK(content(replayed) == svg);
  }

  TEST_CASE("a picture of a flight shows it likewise: truth, motors, names of states and the path") {
    const TemporaryFolder folder;
    const std::string picture = folder / "p.svg";
    CHECK(run_jarol("run specs/javiator.yaml --set distributers.robostix.link.parameters.dynamics=rigid --plot " +
                    picture)
              .exit_code == 0);
    const std::string svg = content(picture);
    CHECK(titles_of(svg) == Titles{"roll", "pitch", "yaw", "altitude", "x", "y", "battery", "state",
                                   "to_robostix.signals", "to_robostix.unlocked", "to_robostix.number", "path"});
    CHECK(count_in(svg, ">true</text>") == 7);  // of angles, altitude and place, and the path
    CHECK(count_in(svg, ">commanded</text>") == 6);
    for (const std::string motor : {"signals.0", "signals.1", "signals.2", "signals.3"})
      CHECK(count_in(svg, ">" + motor + "</text>") == 1);
    for (const std::string state : {"halt", "ground", "starting", "flying", "landing"})
      CHECK(count_in(svg, ">" + state + "</text>") == 1);
    CHECK(count_in(svg, ">east [m], north is up</text>") == 1);
  }

  TEST_CASE("a trace in words has a row of units, and names what enumerators and truth values mean") {
    const TemporaryFolder folder;
    const std::string plain = folder / "p.csv", words = folder / "w.csv";
    CHECK(
        run_jarol("run specs/javiator.yaml --for 40ms --set expect=nothing --trace-fill --trace " + plain).exit_code ==
        0);
    CHECK(
        run_jarol("run specs/javiator.yaml --for 40ms --set expect=nothing --trace-fill --trace-words --trace " + words)
            .exit_code == 0);
    const auto table = [](const std::string& path) {
      std::vector<std::vector<std::string>> rows;
      std::istringstream text(content(path));
      for (std::string line; std::getline(text, line);) {
        std::istringstream cells(line + ",");
        rows.emplace_back();
        for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
      }
      return rows;
    };
    const auto numbers = table(plain), named = table(words);
    REQUIRE(named.size() == numbers.size() + 1);
    CHECK(named[0] == numbers[0]);
    const auto column = [&](const std::string& name) {
      return static_cast<std::size_t>(std::find(named[0].begin(), named[0].end(), name) - named[0].begin());
    };
    CHECK(named[1][0] == "s");
    CHECK(named[1].at(column("filter.estimate.roll")) == "rad");
    CHECK(named[1].at(column("logic.directive.state")).empty());
    CHECK(numbers.back().at(column("logic.directive.state")) == "0");
    CHECK(named.back().at(column("logic.directive.state")) == "halt");
    CHECK(numbers[1].at(column("filter.estimate.roll")) == named[2].at(column("filter.estimate.roll")));
    CHECK(run_jarol(counting + "--trace-words").output ==
          "error: --trace-words is about --trace; add --trace FILE, or leave it out\n");
  }
#endif

  TEST_CASE("nothing is written under the name of another kind of file") {
    for (const std::string name : {"p.png", "p.pdf", "p.SVG"}) {
      CHECK(run_jarol(counting + "--plot " + name).output ==
            "error: --plot: '" + name + "' would hold an SVG picture; name it p.svg\n");
      CHECK(run_jarol("check specs/counting.yaml --svg " + name).output ==
            "error: --svg: '" + name + "' would hold an SVG picture; name it p.svg\n");
      CHECK(!std::filesystem::exists(name));
    }
    CHECK(run_jarol("log report a.mcap -o a.png").output ==
          "error: --out: 'a.png' would hold a page in HTML; name it a.html\n");
    CHECK(run_jarol("log trace a.mcap -o a.png").output ==
          "error: --out: 'a.png' would hold trace events in JSON; name it a.json\n");
  }

  TEST_CASE("- is stdout, which holds nothing else then") {
    const std::string trace = run_jarol(counting + "--trace -", "2>/dev/null").output;
    CHECK(trace.starts_with("time,add.out,count.out,loop.out,slow.out,sum.out,total\n0,,0,,,,0\n"));
    CHECK(trace.find("digest") == std::string::npos);
    const std::string report = run_jarol(counting + "--trace -", "2>&1 >/dev/null").output;
    CHECK(report.find("\n  trace       stdout\n") != std::string::npos);
    CHECK(run_jarol(counting + "--plot - --signals total", "2>/dev/null").output.starts_with("<?xml "));
    CHECK(!std::filesystem::exists("-"));
    CHECK(run_jarol(counting + "--trace - --plot -").output ==
          "error: --trace and --plot both name '-'; choose another file for one of them\n");
    CHECK(run_jarol(counting + "--log -").output == "error: --log: '-' is no file; a recording is read by its name\n");
  }
}

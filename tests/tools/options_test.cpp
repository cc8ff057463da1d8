// Options that would have no effect are refused, each with what it belongs to.
#include <doctest/doctest.h>

#include <filesystem>
#include <string>

#include "tests/tools/run_command.h"

namespace {
using command::run_jarol;
using command::TemporaryFolder;

void check_refused(const std::string& arguments, const std::string& message) {
  CAPTURE(arguments);
  const auto refused = run_jarol(arguments, "2>&1 >/dev/null");
  CHECK(refused.exit_code == 2);
  CHECK(refused.output == "error: " + message + "\n");
}
}  // namespace

TEST_SUITE("tools/options") {
  TEST_CASE("check: what generates graphs and what checks them do not go together") {
    const TemporaryFolder folder;
    const std::string generate = "check --generate waters -o " + (folder / "g");
    const std::string why =
        " is for checking, and --generate writes graphs without checking them; leave out one of the two";
    check_refused(generate + " specs/counting.yaml", "FILE" + why);
    for (const std::string option : {"--set a=1", "--profile p", "--sensitivity", "--chains", "--measure", "--write",
                                     "--lower", "--for 1s", "--margin 5", "--svg x.svg", "--json"})
      check_refused(generate + " " + option, option.substr(0, option.find(' ')) + why);
    CHECK(!std::filesystem::exists(folder / "g"));
    for (const std::string option : {"-o x", "--count 2", "--seed 1", "--tasks 3", "--utilisation 0.5"})
      check_refused("check specs/counting.yaml " + option,
                    option.substr(0, option.find(' ')) +
                        " belongs to --generate; add that, as in --generate waters, or leave it out");
    for (const std::string option : {"--cores 2", "--policy edf"})
      check_refused("check specs/counting.yaml " + option,
                    option.substr(0, option.find(' ')) +
                        " belongs to --generate; of a FILE it is changed by --set, as in --set platform.cores=2 or "
                        "--set platform.policy=edf");
  }

  TEST_CASE("check: what belongs to measuring needs it") {
    const std::string check = "check specs/counting.yaml ";
    const std::string why = " belongs to --write, which writes what was measured; add that, or leave it out";
    check_refused(check + "--margin 5", "--margin" + why);
    check_refused(check + "--measure --margin 5", "--margin" + why);
    check_refused(check + "--measure --lower", "--lower" + why);
    check_refused(check + "--for 1s",
                  "--for says how long to measure, and a verdict holds for ever; add --measure or --write, or leave it "
                  "out");
    const TemporaryFolder folder;
    const std::string seldom =
        folder.write("s.yaml", "{graph: s, tasks: {a: {type: Counter, period: 10s, wcet: 1s}}}\n");
    CHECK(run_jarol("check " + seldom + " --measure --for 100s").exit_code == 0);
  }

  TEST_CASE("check: what is asked for and not there is reported") {
    const TemporaryFolder folder;
    const std::string svg = folder / "none.svg";
    const auto note_on = [](const std::string& arguments) {
      return run_jarol("check " + arguments, "2>&1 >/dev/null");
    };
    const std::string without = folder.write("w.yaml", "{graph: w, tasks: {a: {type: Counter, period: 1ms}}}\n");
    const auto good = note_on(without + " --svg " + svg);
    CHECK(good.exit_code == 3);
    CHECK(good.output == "note: no picture in '" + svg + "', as it needs a 'wcet' of every task\n");
    CHECK(!std::filesystem::exists(svg));
    check_refused("check specs/counting.yaml specs/window.yaml --svg " + svg,
                  "--svg names one picture for several files; check them one by one");
    CHECK(note_on("specs/counting.yaml --chains").output ==
          "note: --chains reports nothing, as no path leads from an 'in' to an 'out'\n");
    const std::string open = folder.write("t.yaml", "{graph: t, tasks: {a: {type: Counter, period: 1ms}}}\n");
    CHECK(note_on("--sensitivity " + open).output ==
          "note: --sensitivity reports nothing, as it needs a 'wcet' of every task\n");
  }

  TEST_CASE("check: paths that are too many are cut off, and that is said") {
    // ten stages of two relays each between an `in` and an `out`
    std::string text =
        "graph: t\ntiming: {period: 10ms}\ncommunicators:\n  i: {type: double, direction: in}\n"
        "  o: {type: double, direction: out}\ntasks:\n";
    std::string connections = "connections:\n", before = "i";
    for (int stage = 0; stage < 10; ++stage) {
      const std::string n = std::to_string(stage);
      text += "  a" + n + ": {type: Relay}\n  b" + n + ": {type: Relay}\n  s" + n + ": {type: Sum}\n";
      connections += "  - " + before + " -> a" + n + ".in\n  - " + before + " -> b" + n + ".in\n  - a" + n +
                     ".out -> s" + n + ".a\n  - b" + n + ".out -> s" + n + ".b\n";
      before = "s" + n + ".out";
    }
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", text + connections + "  - " + before + " -> o\n");
    const auto reported = run_jarol("check --chains " + file);
    CHECK(reported.output.starts_with("note: --chains reports 1000 paths, there are more\n"));
    std::size_t count = 0;
    for (std::size_t at = 0; (at = reported.output.find("\n  chain i -> ", at)) != std::string::npos; ++at) ++count;
    CHECK(count == 1000);
  }

  TEST_CASE("check: where not every way can be followed, a note says that there may be more paths") {
    std::string text =
        "graph: t\ntiming: {period: 10ms}\ncommunicators:\n  i: {type: double, direction: in}\n"
        "  o: {type: double, direction: out}\ntasks:\n  a: {type: Sum, let: 10ms}\n";
    std::string connections = "connections:\n  - i -> a.a\n  - a.out -> o\n", x = "a", y = "a";
    for (int rung = 0; rung < 60; ++rung) {
      const std::string n = std::to_string(rung);
      for (const std::string side : {"x", "y"}) {
        text += "  " + side + n + ": {type: Sum, let: 10ms}\n";
        connections += "  - " + x + ".out -> " + side + n + ".a\n  - " + y + ".out -> " + side + n + ".b\n";
      }
      x = "x" + n;
      y = "y" + n;
    }
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", text + connections + "  - x59.out -> a.b\n");
    const std::string reported = run_jarol("check --chains " + file).output;
    CHECK(reported.starts_with(
        "note: --chains reports 1 path, there may be more: to follow every way would take too long\n"));
    CHECK(reported.find("\n  chain i -> a -> o: ") != std::string::npos);
  }

  TEST_CASE("check: chains of the file are all judged, however many they are") {
    std::string text =
        "graph: t\ntiming: {period: 10ms}\ncommunicators:\n  i: {type: double, direction: in}\n"
        "  o: {type: double, direction: out}\ntasks: {r: {type: Relay, wcet: 1us}}\n"
        "connections: [i -> r.in, r.out -> o]\nchains:\n";
    for (int i = 0; i < 1001; ++i)
      text += "  c" + std::to_string(i) + ": {path: [i, r, o], reaction: " + (i < 1000 ? "1s" : "19ms") + "}\n";
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", text);
    for (const std::string paths : {"", " --chains"}) {
      const auto reported = run_jarol("check " + file + paths);
      CHECK(reported.exit_code == 1);
      CHECK(reported.output.find("    LIMIT BROKEN: reaction 20ms over 19ms\n") != std::string::npos);
      CHECK(reported.output.find("there are more") == std::string::npos);
      CHECK((reported.output.find("\n  chain i -> r -> o: ") != std::string::npos) == (paths != ""));
    }
  }

  TEST_CASE("run: what belongs to the real clock needs it, and threads know less of it") {
    const std::string run = "run specs/counting.yaml --for 1s ";
    for (const std::string option : {"--rt-priority 5", "--cpus 0", "--spin", "--force", "--no-guardian"})
      check_refused(run + option, option.substr(0, option.find(' ')) +
                                      " belongs to the real clock; add --clock real, or leave it out");
    check_refused(run + "--concurrency threads", "--concurrency threads needs --clock real");
    const std::string threads = run + "--clock real --concurrency threads ";
    for (const std::string option : {"--trace x.csv", "--plot x.svg", "--workers 2", "--spin"})
      check_refused(threads + option, option.substr(0, option.find(' ')) + " belongs to --concurrency exotasks");
    check_refused(threads + "--force",
                  "--force belongs to --concurrency exotasks; whether threads come in time is not checked before");
  }

#ifdef JAROL_VEHICLES
  TEST_CASE("vehicle: a script, a link and a description have options of their own") {
    const TemporaryFolder folder;
    const std::string script = folder.write("s.csv", "time,thruster\n0,0.5\n1,0\n"), csv = folder / "out.csv";
    const std::string vehicle = "vehicle submarine ", link = "--link udp --listen 7010 ";
    check_refused(vehicle + link + "--rate 5", "--rate belongs to --csv, where the rows go");
    check_refused(
        vehicle + "--link lockstep --listen 7010 --csv " + csv,
        "--csv has no place in lockstep: what a run does with it is reported there, as by jarol run --record");
    check_refused("vehicle helicopter " + link + "--announce 30100",
                  "--announce: nobody looks for a helicopter, which has no message for that");
    check_refused(vehicle + link + "--script " + script, "--script and --link: either a script steers it or a peer");
    check_refused(vehicle + "--script " + script, "--script needs --csv, where the motion goes");
    check_refused(vehicle + "--describe --script " + script, "--script needs --csv, where the motion goes");
    check_refused(vehicle + "--script " + script + " --csv " + csv + " --json",
                  "--json belongs to --describe, and to --link in real time; add one of them, or leave it out");
    for (const std::string describe : {"", "--describe "}) {
      check_refused(vehicle + describe + "--csv " + csv,
                    "--csv belongs to --script or --link, which move it; add one, or leave it out");
      check_refused(vehicle + describe + "--listen 7010", "--listen needs --link");
    }
    for (const std::string option : {"--initial z=4", "--for 1s", "--seed 1"})
      check_refused(vehicle + "--describe " + option,
                    option.substr(0, option.find(' ')) + " needs --script or --link: --describe does not move it");
    check_refused(vehicle + "--describe --bare", "--bare needs --link, and one in real time");
    check_refused(vehicle + "--describe --rt-priority 5", "--rt-priority belongs to --link in real time");
    CHECK(!std::filesystem::exists(csv));
  }

  TEST_CASE("vehicle: on TCP it listens, unless it is told whom to connect to") {
    const std::string tcp = "vehicle helicopter --for 20ms --link tcp ";
    CHECK(run_jarol(tcp + "--listen 0").output.starts_with("helicopter: tcp at 127.0.0.1:0, until Ctrl-C\n"));
    CHECK(run_jarol(tcp + "--peer 1").output.starts_with("helicopter: tcp to 127.0.0.1:1, until Ctrl-C\n"));
    CHECK(run_jarol(tcp).output.starts_with("--link:1:1: error: link lacks the key 'listen': port to listen at"));
  }

  TEST_CASE("vehicle: a key is read before anything else, on each link that can have one") {
    const std::string why = "the key file 'no_such.key' can't be read: No such file or directory; make one by: ";
    for (const std::string link : {"udp --listen 0", "tcp --listen 0", "tcp --peer 1"}) {
      const auto refused = run_jarol("vehicle submarine --link " + link + " --key no_such.key");
      CHECK(refused.exit_code == 2);
      CHECK(refused.output.starts_with("--key:1:1: error: " + why));
    }
    check_refused("vehicle submarine --link lockstep --listen 7010 --key no_such.key",
                  why + "(umask 077; head -c 32 /dev/urandom > no_such.key)");
    CHECK(run_jarol("vehicle submarine --link serial --device x --key no_such.key")
              .output.starts_with(
                  "--key:1:1: error: link has no key 'key'; it has: type, device, baud, id, source, port"));
  }

  TEST_CASE("vehicle: in lockstep those who run a graph with it say how long, and with what seed") {
    const std::string lockstep = "vehicle submarine --link lockstep --listen 7010 ";
    check_refused(lockstep + "--for 1s",
                  "--for has no place in lockstep: those who run a graph with it say how long, as in jarol run --for "
                  "10s");
    check_refused(lockstep + "--seed 1",
                  "--seed has no place in lockstep: it is that of the graph's run, as in jarol run --seed 7");
    check_refused(lockstep + "--json",
                  "--json belongs to --describe, and to --link in real time; add one of them, or leave it out");
    check_refused(lockstep + "--bare", "--bare needs --link, and one in real time");
    check_refused(lockstep + "--rt-priority 5", "--rt-priority belongs to --link in real time");
  }
#endif
}

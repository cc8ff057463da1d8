// Graphs on ordinary threads, as the command runs them.
#include <doctest/doctest.h>
#include <sys/socket.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/tools/process.h"
#include "tests/tools/run_command.h"

namespace {
using command::TemporaryFolder;

constexpr const char* on_threads = " --clock real --concurrency threads --for ";
}  // namespace

TEST_SUITE("tools/threads") {
  TEST_CASE("a run on threads reports the time covered, and what was commanded and reached, as one of exotasks does") {
    const auto run = command::run_jarol(std::string("run specs/exolauv.yaml") + on_threads + "1.2s", "2>/dev/null");
    CHECK(run.exit_code == 0);
    CHECK(
        run.output.starts_with("exolauv: 1.2 s in real time on threads\n"
                               "               commanded     reached        true\n  depth            0.000"));
  }

  TEST_CASE("a run on threads reports lateness, what each task took, and the last outputs, as one of exotasks does") {
    const auto reported_of = [](const std::string& concurrency) {
      return nlohmann::json::parse(
          command::run_jarol("run specs/exolauv.yaml --for 1s --json --clock real" + concurrency, "2>/dev/null")
              .output);
    };
    const auto threads = reported_of(" --concurrency threads"), exotasks = reported_of("");
    for (const auto& [key, value] : exotasks.items()) {
      CAPTURE(key);
      CHECK(threads.contains(key));
    }
    CHECK(threads["concurrency"] == "threads");
    CHECK(exotasks["concurrency"] == "exotasks");
    CHECK(threads["digest_claimed"] == false);
    CHECK(threads["outputs"].size() == 6);
    for (const auto& [output, value] : exotasks["outputs"].items()) {
      CAPTURE(output);
      REQUIRE(threads["outputs"].contains(output));
      for (const auto& [field, number] : value.items()) CHECK(threads["outputs"][output].contains(field));
    }
    const auto& time = threads["real_time"];
    CHECK(time["lateness_50_ns"] > 0);
    CHECK(time["lateness_50_ns"] <= time["lateness_99_ns"]);
    CHECK(time["lateness_99_ns"] <= time["lateness_max_ns"]);
    CHECK(time["outputs_50_ns"] > time["lateness_50_ns"]);  // both from the tick on
    CHECK(time["tasks"].size() == 9);
    std::uint64_t activations = 0;
    for (const auto& [task, timing] : time["tasks"].items()) {
      CAPTURE(task);
      CHECK(exotasks["real_time"]["tasks"].contains(task));
      CHECK(timing["execution_99_ns"] > 0);
      CHECK(timing["execution_99_ns"] <= timing["execution_max_ns"]);
      activations += timing["activations"].get<std::uint64_t>();
    }
    CHECK(activations == threads["activations"]);
    const std::string text =
        command::run_jarol(std::string("run specs/exolauv.yaml") + on_threads + "200ms", "2>/dev/null").output;
    CHECK(text.find("\n              nothing is claimed of the digest: its tasks ran on threads\n") !=
          std::string::npos);
    CHECK(text.find("\n  rounds      ") < text.find("\n  outputs     "));
    CHECK(text.find(" us worst\n  task        activations     99 % us    worst us\n  depth ") != std::string::npos);
  }

  TEST_CASE("a run on threads judges what is published and true values, as one of exotasks does") {
    const TemporaryFolder folder;
    const std::string mission = " --set distributers.neptus.link.file=" +
                                folder.write("short.csv", "time,setpoint.depth,setpoint.speed\n0,1,1.2\n1.5,1,1.2\n");
    const auto run = [&](const std::string& expect, const std::string& options) {
      return command::run_jarol("run specs/exolauv_bare.yaml --clock real --set 'expect=[" + expect + "]' " + options);
    };
    for (const std::string concurrency : {"exotasks", "threads"}) {
      CAPTURE(concurrency);
      const std::string options = "--concurrency " + concurrency + mission;
      const auto good = run("speed of dune > 0.2, always depth of dune < 1, max(to_dune.thruster) > 0.2", options);
      CAPTURE(good.output);
      CHECK(good.exit_code == 0);
      CHECK(good.output.find("  expected    speed of dune > 0.2: holds, ") != std::string::npos);
      CHECK(good.output.find("  expected    always depth of dune < 1: holds\n") != std::string::npos);
      CHECK(good.output.find("  expected    max(to_dune.thruster) > 0.2: holds, ") != std::string::npos);
      CHECK(good.output.find("not judged") == std::string::npos);
      const auto bad = run("speed of dune < 0.1, never to_dune.thruster > 0.2", options);
      CAPTURE(bad.output);
      CHECK(bad.exit_code == 1);
      CHECK(bad.output.find("  expected    speed of dune < 0.1: FAILS: reached ") != std::string::npos);
      CHECK(bad.output.find("error: expected 'speed of dune < 0.1', but it reached ") != std::string::npos);
      CHECK(bad.output.find("error: expected 'never to_dune.thruster > 0.2', but it was so at ") != std::string::npos);
      const auto cut =
          run("speed of dune < 0.1, max(to_dune.thruster) < 0.2, once depth of dune > 100", options + " --for 1s");
      CHECK(cut.exit_code == 1);
      const std::string short_run = ": not judged: the run ended at 1 s, its mission ends at 1.5 s\n";
      CHECK(cut.output.find("  expected    speed of dune < 0.1" + short_run) != std::string::npos);
      CHECK(cut.output.find("  expected    once depth of dune > 100" + short_run) != std::string::npos);
      CHECK(cut.output.find("  expected    max(to_dune.thruster) < 0.2: FAILS: reached ") != std::string::npos);
    }
  }

  TEST_CASE("a vehicle that is lost ends the run, and is reported") {
    // later where the machine had not come so far that there was anything to lose
    std::string errors, port;
    int exit_code = -1;
    double lost_at = 0;
    for (auto wait = std::chrono::milliseconds(500); lost_at == 0 && wait < std::chrono::minutes(1); wait *= 2) {
      port = jarol::tests::free_port(SOCK_STREAM);
      jarol::tests::Process vehicle("vehicle submarine --link lockstep --listen " + port);
      REQUIRE(vehicle.says("in lockstep at"));
      jarol::tests::Process run(std::string("run specs/exolauv.yaml") + on_threads +
                                "1h --set 'distributers.dune.link={type: lockstep, peer: " + port + "}'");
      std::this_thread::sleep_for(wait);
      vehicle.kill();
      exit_code = run.end();
      errors = run.errors();
      const std::size_t at = errors.find("error: at ");
      if (at != std::string::npos) lost_at = std::stod(errors.substr(at + 10));
    }
    CHECK(exit_code == 3);
    CHECK(lost_at > 0);
    CHECK(errors.substr(errors.find(" s: ", errors.find("error: at "))) ==
          " s: the vehicle at 127.0.0.1:" + port + " has ended the connection\n");
  }

  TEST_CASE("the first thousand faults stand in JSON, and the text sums them up by task and cause") {
    const TemporaryFolder folder;
    std::string text =
        "graph: g\ntiming: {period: 1ms}\ncommunicators: {i: {type: double, direction: in, init: 1e308}}\n";
    std::string tasks = "tasks:\n", connections = "connections:\n";
    for (int t = 0; t < 50; ++t) {
      const std::string name = "t" + std::to_string(t);
      tasks += "  " + name + ": {type: Sum, on_fault: hold}\n";
      connections += "  - i -> " + name + ".a\n  - i -> " + name + ".b\n";
    }
    const auto graph = folder.write("g.yaml", text + tasks + connections);
    for (const char* concurrency : {"exotasks --clock virtual", "threads --clock real"}) {
      const std::string arguments = "run " + graph + " --concurrency " + concurrency + " --for ";
      // longer where the machine left out so many rounds that there were fewer
      nlohmann::json json;
      std::string reported;
      std::size_t more = std::string::npos;
      for (int ms = 100; more == std::string::npos && ms < 60'000; ms *= 2) {
        const std::string time = std::to_string(ms) + "ms";
        json = nlohmann::json::parse(command::run_jarol(arguments + time + " --json", "2>/dev/null").output);
        if (json["fault_count"] <= 1000) continue;
        reported = command::run_jarol(arguments + time, "2>&1 >/dev/null").output;
        more = reported.find(" times, from activation ");
      }
      CHECK(json["faults"].size() == 1000);
      CHECK(json["fault_count"] == json["activations"]);
      REQUIRE(more != std::string::npos);
      // a line for each task and cause, and one for what each task left out
      CHECK(std::count(reported.begin(), reported.end(), '\n') == 100);
    }
  }
}

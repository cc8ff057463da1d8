// Vehicles that come to rest before their run ends, in real time over real links, by where they truly are.
// In one file: the runs go on side by side.
#include <doctest/doctest.h>
#include <signal.h>
#include <sys/socket.h>

#include <cmath>
#include <future>
#include <thread>

#include "tests/tools/process.h"
#include "tests/tools/run_command.h"

namespace {
using namespace jarol::tests;
using namespace std::chrono_literals;
using command::TemporaryFolder;
using nlohmann::json;

struct Outcome {
  int exit_code = -1;
  json run;
  int vehicle_exit_code = -1;
  json vehicle;  // where it truly was a while after the run's end
  std::string errors;
  json replay;
  std::string info;  // of the log
};

// What is done to a run that steers.
using Act = std::function<void(Process&)>;

void interrupt(Process& run) { run.interrupt(); }
void terminate(Process& run) { run.signal(SIGTERM); }
void wait_for_end(Process&) {}

// Two seconds after the first signal it is on its way down: it has missed its operator for half a second.
void interrupt_twice(Process& run) {
  run.signal(SIGTERM);
  CHECK(run.says("interrupt again to hand over the safe commands at once"));
  std::this_thread::sleep_for(1700ms);
  run.interrupt();
}

void kill_on_the_way(Process& run) {
  run.interrupt();
  CHECK(run.says("interrupt again to hand over the safe commands at once"));
  std::this_thread::sleep_for(1700ms);
  run.kill();
}

Outcome outcome(const std::string& vehicle_words, const std::string& run_words, const std::string& log,
                const Act& act) {
  Process vehicle("vehicle " + vehicle_words + " --json");
  Outcome all;
  if (!vehicle.says("until Ctrl-C")) {
    all.errors = vehicle.errors();
    return all;
  }
  {
    Process run("run " + run_words + " --clock real --json --set fault_limit=100% --set expect=nothing" +
                (log.empty() ? "" : (log.ends_with(".mcap") ? " --record " : " --log ") + log));
    std::this_thread::sleep_for(8s);
    act(run);
    all.exit_code = run.end();
    all.errors = run.errors();
    if (!run.output().empty()) all.run = run.json();
  }
  std::this_thread::sleep_for(1500ms);  // for what has to fall
  vehicle.interrupt();
  all.vehicle_exit_code = vehicle.end();
  all.vehicle = vehicle.json();
  if (!log.empty()) all.info = command::run_jarol("log info " + log).output;
  if (!log.empty()) all.replay = json::parse(command::run_jarol("replay " + log + " --json", "2>/dev/null").output);
  return all;
}

struct Files {
  TemporaryFolder folder;
  // to 1 m, and from 5 s on towards the east
  std::string hover = folder.write("hover.csv",
                                   "time,command.altitude,command.y,command.mode_switches,command.state_switches\n"
                                   "0,0,0,1,0\n0.3,0,0,1,1\n0.6,0,0,1,2\n2.5,1,0,1,2\n5,1,5,1,2\n600,1,5,1,2\n");
  std::string deep =
      folder.write("deep.csv", "time,setpoint.depth,setpoint.heading,setpoint.speed\n0,3,0deg,1.2\n600,3,0deg,1.2\n");
  std::string plan = folder.write("plan.csv",
                                  "time,leg.number,leg.course,leg.north,leg.level,leg.surge\n"
                                  "0,1,line,900,3,1.2\n600,1,line,900,3,1.2\n");
};

Outcome helicopter(const Files& files, const std::string& link, const std::string& more, const std::string& log,
                   const Act& act) {
  const std::string port = free_port(link == "udp" ? SOCK_DGRAM : SOCK_STREAM);
  return outcome("helicopter --parameters specs/vehicles/helicopter.yaml --link " + link + " --listen " + port,
                 "specs/javiator.yaml --set distributers.terminal.link.file=" + files.hover +
                     " --set 'distributers.robostix.link={type: " + (link == "udp" ? "udp" : "tcp_client") +
                     ", peer: " + port + "}' " + more,
                 log.empty() ? "" : files.folder / log, act);
}

Outcome submarine(const Files& files, const std::string& more, const std::string& log, const Act& act,
                  const std::string& vehicle_more = "") {
  const std::string port = free_port(SOCK_DGRAM);
  return outcome("submarine --initial z=3 --link udp --id 0x00D1 --listen " + port + " " + vehicle_more,
                 "specs/exolauv.yaml --set distributers.neptus.link.file=" + files.deep +
                     " --set 'distributers.dune.link={type: udp, peer: " + port + ", id: 16385, source: 0x00D1}' " +
                     more,
                 log.empty() ? "" : files.folder / log, act);
}

const std::string never = "--set 'at_end.until=logic.directive.state is starting' --set at_end.longest=4500ms ";

constexpr const char* gauge_failures[] = {"{kind: lost, at: 5 s}", "{kind: stuck, at: 5 s}",
                                          "{kind: biased, at: 5 s, by: -3}"};

// All at once.
class Runs {
 public:
  Runs() {
    begin("signal", [this] { return helicopter(files_, "udp", "", "signal.log", interrupt); });
    begin("tcp", [this] { return helicopter(files_, "tcp", "--for 8s", "", wait_for_end); });
    begin("threads", [this] { return helicopter(files_, "udp", "--concurrency threads", "", terminate); });
    begin("second", [this] { return helicopter(files_, "udp", "", "second.mcap", interrupt_twice); });
    begin("never", [this] { return helicopter(files_, "udp", never + "--for 8s", "never.log", wait_for_end); });
    begin("killed", [this] { return helicopter(files_, "udp", "", "", kill_on_the_way); });
    begin("submarine", [this] { return submarine(files_, "", "submarine.log", terminate); });
    begin("submarine with a plan",
          [this] { return submarine(files_, "--set distributers.neptus.link.file=" + files_.plan, "", interrupt); });
    begin("submarine on threads",
          [this] { return submarine(files_, "--concurrency threads --for 8s", "", wait_for_end); });
    for (const std::string failure : gauge_failures)
      begin(failure, [this, failure] {
        return submarine(files_, "--for 8s", "", wait_for_end, "--set 'sensors.depth.failure=" + failure + "'");
      });
  }
  Outcome operator[](const std::string& name) const { return runs_.at(name).get(); }

 private:
  void begin(const std::string& name, std::function<Outcome()> run) {
    runs_[name] = std::async(std::launch::async, std::move(run)).share();
  }
  Files files_;
  std::map<std::string, std::shared_future<Outcome>> runs_;
};

const Runs& runs() {
  static const Runs all;
  return all;
}

double seconds(const json& ns) { return 1e-9 * ns.get<double>(); }

// It stands where it landed, whole, its motors off.
void check_landed(const Outcome& o) {
  CHECK(o.run["rest"]["reached"] == true);
  CHECK(seconds(o.run["rest"]["took_ns"]) > 2);
  CHECK(o.run["failsafe"]["to_robostix"]["at_end"] == true);
  CHECK(o.vehicle["mishap"].is_null());
  CHECK(std::abs(o.vehicle["state"]["z"].get<double>()) < 0.2);
  for (const auto& [name, signal] : o.vehicle["actuators"].items()) CHECK(std::abs(signal.get<double>()) < 30);
}

void check_surfaced(const Outcome& o) {
  CHECK(o.run["rest"]["reached"] == true);
  CHECK(seconds(o.run["rest"]["took_ns"]) > 4);
  CHECK(o.run["failsafe"]["to_dune"]["at_end"] == true);
  CHECK(o.vehicle["mishap"].is_null());
  CHECK(o.vehicle["state"]["z"] < 0.3);
}
}  // namespace

TEST_SUITE("tools/at_end") {
  TEST_CASE("a helicopter in flight lands at the first signal, and its log is replayed to the same digest") {
    const Outcome o = runs()["signal"];
    INFO(o.errors);
    CHECK(o.exit_code == 130);
    check_landed(o);
    CHECK(o.run["rest"]["reason"] == "SIGINT ended the run");
    CHECK(o.run["rest"]["command"] == json::parse(R"({"from_terminal": {"heard": false}})"));
    CHECK(o.run["ending"]["signal"] == "SIGINT");
    CHECK(o.errors.find("ending, as SIGINT ended the run: from_terminal {heard: false} until logic.directive.state is "
                        "ground or halt, at most 30s; interrupt again to hand over the safe commands at once\n") !=
          std::string::npos);
    // it was on its way to the east
    CHECK(o.vehicle["state"]["y"] > 0.3);
    CHECK(o.replay["verdict"] == "same");
    CHECK(o.replay["digest"] == o.run["digest"]);
    CHECK(o.replay["log"]["rest_begun_ns"] == o.run["rest"]["begun_ns"]);
    CHECK(o.replay["judgement"]["not_at_rest"].is_null());
    CHECK(o.info.find("\n  ended       as SIGINT ended the run\n") != std::string::npos);
    CHECK(o.vehicle_exit_code == 130);
  }

  TEST_CASE("it lands at the end of --for, and by threads") {
    const Outcome tcp = runs()["tcp"];
    CHECK(tcp.exit_code == 0);
    CHECK(tcp.run["rest"]["reason"] == "the run was over");
    CHECK(tcp.run["rest"]["begun_ns"] == 8'005'000'000);  // the first instant from 8 s on
    check_landed(tcp);
    const Outcome threads = runs()["threads"];
    CHECK(threads.exit_code == 143);
    check_landed(threads);
  }

  TEST_CASE("a second signal on the way down turns the motors off in the air; the exit code is the first one's") {
    const Outcome o = runs()["second"];
    INFO(o.errors);
    CHECK(o.exit_code == 143);
    CHECK(o.run["rest"]["reached"] == false);
    CHECK(o.run["rest"]["cut_short_by"] == "a second signal came");
    CHECK(seconds(o.run["rest"]["took_ns"]) < 3);
    CHECK(o.run["failsafe"]["to_robostix"]["at_end"] == true);
    CHECK(
        o.errors.ends_with("error: the vehicle did not come to rest: 'logic.directive.state is ground or halt' was "
                           "not so when a second signal came\n"));
    // it fell, which its own process tells, and that it did not come to rest whoever replays
    CHECK(o.vehicle["mishap"].is_string());
    CHECK(o.vehicle_exit_code == 1);
    CHECK(o.replay["verdict"] == "same");
    CHECK(o.replay["judgement"]["not_at_rest"] == "the vehicle of the run did not come to rest");
    CHECK(o.info.find("\n  ended       as SIGTERM ended the run\n") != std::string::npos);
    CHECK(o.info.find(" s on the vehicle was to come to rest: NOT AT REST\n") != std::string::npos);
  }

  TEST_CASE("what never comes to rest gets safe after the longest time, and the run ends with 1") {
    const Outcome o = runs()["never"];
    INFO(o.errors);
    CHECK(o.exit_code == 1);
    CHECK(o.run["rest"]["reached"] == false);
    CHECK(o.run["rest"]["took_ns"] == 4'500'000'000);
    CHECK(!o.run["rest"].contains("cut_short_by"));
    CHECK(o.run["judgement"]["not_at_rest"].is_string());
    CHECK(o.run["failsafe"]["to_robostix"]["at_end"] == true);
    CHECK(
        o.errors.ends_with("error: the vehicle did not come to rest: 'logic.directive.state is starting' was not so "
                           "within 4.5s\n"));
    CHECK(o.vehicle["mishap"].is_null());  // it had landed
    CHECK(o.replay["digest"] == o.run["digest"]);
  }

  TEST_CASE("of a controller that is killed on the way to rest the guardian hands over what is safe") {
    const Outcome o = runs()["killed"];
    CHECK(o.errors.find("guardian: the controller is gone without having closed; sent 'safe': ") != std::string::npos);
    for (const auto& [name, signal] : o.vehicle["actuators"].items()) CHECK(std::abs(signal.get<double>()) < 30);
  }

  TEST_CASE("a submarine in 3 m drives up") {
    const Outcome o = runs()["submarine"];
    INFO(o.errors);
    CHECK(o.exit_code == 143);
    check_surfaced(o);
    CHECK(o.replay["verdict"] == "same");
    CHECK(o.replay["digest"] == o.run["digest"]);
    const Outcome threads = runs()["submarine on threads"];
    CHECK(threads.exit_code == 0);
    check_surfaced(threads);
  }

  TEST_CASE("a submarine that flies a plan in 3 m drives up") {
    const Outcome o = runs()["submarine with a plan"];
    INFO(o.errors);
    CHECK(o.exit_code == 130);
    check_surfaced(o);
  }

  TEST_CASE("a submarine whose depth gauge is lost, stuck below or reads the surface in 3 m drives up") {
    for (const char* failure : gauge_failures) {
      const Outcome o = runs()[failure];
      CAPTURE(std::string(failure));
      INFO(o.errors);
      CHECK(o.exit_code == 0);
      check_surfaced(o);
    }
  }

  TEST_CASE(
      "where a graph believes a vehicle at rest that is not, its true state fails the run, and whoever replays it") {
    const Files files;
    for (const char* concurrency : {"exotasks", "threads"}) {
      CAPTURE(std::string(concurrency));
      const std::string log = files.folder / "deep.mcap";
      const auto run = command::run_jarol(
          "run specs/exolauv.yaml --clock real --for 9s --json --set fault_limit=100% --set expect=nothing "
          "--concurrency " +
              std::string(concurrency) +
              " --set 'at_end.until=navigation.motion.z < 50' --set distributers.neptus.link.file=" + files.deep +
              (*concurrency == 'e' ? " --record " + log : ""),
          "2>/dev/null");
      CHECK(run.exit_code == 1);
      const json report = json::parse(run.output);
      CHECK(report["rest"]["reached"] == true);
      REQUIRE(report["judgement"]["mishaps"].size() == 1);
      const std::string text = report["judgement"]["mishaps"][0]["text"];
      CHECK(text.starts_with("not come to rest: it is "));
      CHECK(text.ends_with(" m deep"));
      if (*concurrency == 't') continue;
      const auto replay = command::run_jarol("replay " + log);
      CHECK(replay.exit_code == 1);
      CHECK(replay.output.find("the vehicle of 'dune' has " + text) != std::string::npos);
    }
  }
}

// However a run ends, whatever its links, clock and threads: what has a `safe` gets it, in time, and nothing after it.
#include <doctest/doctest.h>
#include <signal.h>

#include <cstdlib>
#include <thread>

#include "tests/how_many.h"
#include "tests/tools/actuator_peer.h"
#include "tests/tools/process.h"
#include "tests/tools/run_command.h"

namespace {
using namespace jarol::tests;
using namespace std::chrono_literals;
using command::TemporaryFolder;
using Milliseconds = std::chrono::duration<double, std::milli>;

constexpr double steers = 0.5, safe = 0.25, comes_to_rest = 0.125;  // thrusts
constexpr auto in_time = 100ms;

// How a run is ended. A row more is an element more of `endings`.
struct Ending {
  std::string name;
  std::string task;     // type and keys of a task that ends it, or none
  std::string options;  // of the command
  std::chrono::milliseconds before_act{};
  // done from outside, with the run and what it steers; none: it ends by itself
  std::function<void(Process&, ActuatorPeer* lost)> act;
  // ms after the run's start at which it ends by itself
  std::chrono::milliseconds at{};
  int exit_code = 0;
  std::string reason;  // in its report
  bool loses = false;  // a vehicle of its own in lockstep, which vanishes
  bool rests = false;  // where the graph states how, its vehicle comes to rest first
};

void wait_for_end(Process& run) {
  // Ctrl-Z halts it; what goes on with it too early takes Ctrl-Z back
  while (run.runs()) {
    run.signal(SIGCONT);
    std::this_thread::sleep_for(5ms);
  }
}

auto send(int signal) {
  return [signal](Process& run, ActuatorPeer*) { run.signal(signal); };
}

const std::vector<Ending>& endings() {
  static const std::vector<Ending> all{
      {"SIGINT", "", "--for 1h", 100ms, send(SIGINT), {}, 130, "SIGINT ended the run", false, true},
      {"SIGTERM", "", "--for 1h", 100ms, send(SIGTERM), {}, 143, "SIGTERM ended the run", false, true},
      {"SIGHUP", "", "--for 1h", 100ms, send(SIGHUP), {}, 129, "SIGHUP ended the run", false, true},
      {"SIGTSTP", "", "--for 1h", 100ms, send(SIGTSTP), {}, 148, "SIGTSTP ended the run", false, true},
      {"--for", "", "--for 300ms", 0ms, nullptr, 300ms, 0, "the run was over", false, true},
      {"a fault", "{type: Throws, parameters: {at: 15}}", "--for 1h", 0ms, nullptr, 300ms, 3, "a fault ended the run"},
      {"a task that never ends", "{type: Hangs, parameters: {at: 15}}", "--for 1h", 0ms, nullptr, 320ms, 3, ""},
      {"one that never ends where faults are held",
       "{type: Hangs, on_fault: hold, parameters: {at: 10}}",
       "--for 1h",
       500ms,
       send(SIGINT),
       {},
       3,
       "SIGINT ended the run"},
      {"one with a wcet that never ends where faults are held",
       "{type: Hangs, wcet: 100us, on_fault: hold, parameters: {at: 10}}", "--for 1h", 0ms, nullptr, 1220ms, 3,
       "task 'ends' activation 10 at 0.2 s has not ended, which ended the run"},
      {"--for with one that never ends", "{type: Hangs, on_fault: hold, parameters: {at: 10}}", "--for 300ms", 0ms,
       nullptr, 300ms, 3, ""},
      {"a lost vehicle",
       "",
       "--for 1h",
       100ms,
       [](Process&, ActuatorPeer* lost) { lost->vanish(); },
       {},
       3,
       "an external system was lost",
       true},
  };
  return all;
}

struct Way {
  std::string link, clock, policy;
};

std::vector<Way> ways() {
  std::vector<Way> all;
  for (const std::string link : {"udp", "tcp_client", "tcp_server", "serial", "lockstep"})
    for (const std::string policy :
         {"{cores: 1, policy: table}", "{cores: 2, policy: table}", "{cores: 1, policy: fixed_priority}",
          "{cores: 2, policy: fixed_priority}", "threads"})
      all.push_back({link, "real", policy});
  all.push_back({"lockstep", "virtual", "{cores: 1, policy: table}"});
  return all;
}

// How the vehicle comes to rest, where the graph states it.
const std::string comes_to_rest_first =
    "at_end: {command: {thrust: {thruster: 0.125}}, until: to_dune.thruster < 0.2, longest: 10s}\n";

std::string graph_of(const Ending& ending, const Way& way, const ActuatorPeer& peer, const ActuatorPeer* lost,
                     const std::string& at_end, const std::string& mission) {
  const std::string platform = way.policy == "threads" ? "{cores: 1, policy: table}" : way.policy;
  std::string text = "graph: ends\ntiming: {period: 20ms}\nplugins: [ends.so]\nplatform: " + platform +
                     "\ndistributers:\n  dune: {type: LauvVehicle, link: " + peer.link() + "}\n" +
                     (lost != nullptr ? "  other: {type: LauvVehicle, link: " + lost->link() + "}\n" : "") +
                     "  operator: {type: LauvOperator, link: {type: script, file: " + mission +
                     "}}\n"
                     "communicators:\n"
                     "  thrust: {channel: operator.actuation, init: {thruster: 0.5}}\n"
                     "  from_dune: {channel: dune.motion, timeout: 1min}\n"
                     "  to_dune: {channel: dune.actuation, safe: {thruster: 0.25}}\n" +
                     (lost != nullptr ? "  from_other: {channel: other.motion}\n" : "") +
                     "tasks:\n"
                     "  forward: {type: LauvForward, on_fault: hold}\n" +
                     (lost != nullptr ? "  second: {type: LauvForward, on_fault: hold}\n" : "") +
                     (ending.task.empty() ? "" : "  ends: " + ending.task + "\n") +
                     "connections:\n"
                     "  - from_dune -> forward.motion\n"
                     "  - thrust -> forward.actuation\n"
                     "  - forward.actuation -> to_dune\n";
  if (lost != nullptr) text += "  - from_other -> second.motion\n  - thrust -> second.actuation\n";
  return text + at_end;
}

// One run; how long after its end the peer had what is safe. None: it ended before it had steered, or the machine was
// so busy that its tasks were left out.
std::optional<double> end_one(const Ending& ending, const Way& way, const std::string& at_end) {
  const TemporaryFolder folder;
  std::filesystem::copy_file(JAROL_PLUGIN_FOLDER "/ends.so", folder / "ends.so",
                             std::filesystem::copy_options::overwrite_existing);
  const auto peer = make_actuator_peer(way.link);
  const auto lost = ending.loses ? make_actuator_peer("lockstep") : nullptr;
  const std::string mission = folder.write("m.csv", "time,actuation.thruster\n0,0.5\n7200,0.5\n");
  const std::string graph = folder.write("g.yaml", graph_of(ending, way, *peer, lost.get(), at_end, mission));
  Process run("run " + graph + " --json --clock " + way.clock + " " + ending.options +
              (way.policy == "threads" ? " --concurrency threads" : ""));
  while (run.runs() && !peer->has(steers)) std::this_thread::sleep_for(1ms);
  if (!peer->has(steers)) {
    CAPTURE(run.end());
    CAPTURE(run.errors());
    CHECK(ending.act == nullptr);
    return std::nullopt;
  }
  PeerClock::time_point ended{};
  if (ending.act) {
    std::this_thread::sleep_for(ending.before_act);
    ended = PeerClock::now();
    ending.act(run, lost.get());
  }
  const auto patience = PeerClock::now() + 20s;
  while (peer->thrusts().back().value != safe && PeerClock::now() < patience) std::this_thread::sleep_for(1ms);
  wait_for_end(run);
  CAPTURE(run.errors());
  CAPTURE(run.output());
  if (ending.exit_code == 0 && run.end() == 1 && !run.json()["judgement"]["left_out"].empty()) return std::nullopt;
  CHECK(run.end() == ending.exit_code);
  const std::vector<Thrust> thrusts = peer->thrusts();
  // at the start the run may have taken its peer for silent
  const auto steered =
      std::find_if(thrusts.rbegin(), thrusts.rend(), [](const Thrust& t) { return t.value == steers; });
  auto last = steered.base();
  const bool rests = !at_end.empty() && ending.rests && way.clock == "real";
  const auto on_its_way = last;
  while (rests && last != thrusts.end() && last->value == comes_to_rest) ++last;
  CHECK((last != on_its_way) == rests);
  REQUIRE(last != thrusts.end());
  CHECK(last->value == safe);
  // and no other command follows
  CHECK(last + 1 == thrusts.end());
  const auto json = run.json();
  if (!ending.reason.empty()) CHECK(json["ending"]["reason"] == ending.reason);
  CHECK(json["rest"].is_null() == !rests);
  if (rests) CHECK(json["rest"]["reached"] == true);
  CHECK(json["failsafe"]["to_dune"]["at_end"] == true);
  CHECK(json["failsafe"]["to_dune"]["at_end_value"]["thruster"] == safe);
  // the virtual clock has no time that a peer could measure
  if (!ending.act && way.clock == "virtual") return 0;
  if (!ending.act) ended = thrusts.front().at + ending.at;
  return std::chrono::duration_cast<Milliseconds>(last->at - ended).count();
}

void check_one(const Ending& ending, const Way& way, const std::string& at_end) {
  CAPTURE(ending.name);
  CAPTURE(way.link);
  CAPTURE(way.clock);
  CAPTURE(way.policy);
  double min = 1e9;
  // a machine that is busy with other things may be late
  for (int attempt = 0; attempt < 10 && min > Milliseconds(in_time).count(); ++attempt)
    min = std::min(min, end_one(ending, way, at_end).value_or(min));
  CHECK(min <= Milliseconds(in_time).count());
}

// On the virtual clock no task is late: one that never ends waits for a signal, after a note.
bool exists(const Ending& ending, const Way& way) {
  if (way.clock == "virtual") return ending.act != nullptr || ending.task.find("Hangs") == std::string::npos;
  // whether a task comes in time is not looked at there: it ends the run after a second
  if (way.policy == "threads" && ending.name == "a task that never ends") return false;
  return true;
}

// Each ending on each link, and in each way on one, or all of them.
template <class Wanted>
void check_all(const std::string& at_end, const Wanted& wanted) {
  const bool all = jarol::tests::is_full();
  int count = 0;
  for (const Way& way : ways())
    for (const Ending& ending : endings()) {
      const bool plain = way.policy == "{cores: 1, policy: table}";
      if (!exists(ending, way) || !wanted(ending) || (!all && !plain && way.link != "udp")) continue;
      const auto begin = PeerClock::now();
      check_one(ending, way, at_end);
      ++count;
      if (std::getenv("JAROL_TIMES") != nullptr)
        MESSAGE(way.link << " " << way.policy << " " << ending.name << " "
                         << std::chrono::duration_cast<Milliseconds>(PeerClock::now() - begin).count() << " ms");
    }
  MESSAGE(count << " endings");
}
}  // namespace

TEST_SUITE("tools/endings") {
  TEST_CASE("what is safe goes out at each ending, on each link, in each way of running, and nothing after it") {
    check_all("", [](const Ending&) { return true; });
  }

  TEST_CASE(
      "where a graph states how its vehicle comes to rest, it is commanded to do that before, unless nothing can be "
      "trusted") {
    // what hangs and may be late is waited for
    check_all(comes_to_rest_first,
              [](const Ending& ending) { return ending.task.find("on_fault: hold") == std::string::npos; });
  }
}

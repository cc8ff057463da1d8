// What a vehicle is sent when its controller crashes, or is killed: measured at the vehicle.
#include "distributers/guardian/guardian.h"

#include <doctest/doctest.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>

#include <cstdlib>
#include <future>
#include <iostream>
#include <thread>

#include "tests/tools/guarded_run.h"
#include "tests/tools/process.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;
using tests::GuardedVehicle;
using tests::Process;

constexpr auto limit = 100ms;  // longer than the period of all communicators

// A process that this one has to wait for, as its parent is gone: its exit code, or minus a signal.
int end_of(pid_t process) {
  int status = 0;
  for (int i = 0; i < 10'000 && waitpid(process, &status, WNOHANG) == 0; ++i) std::this_thread::sleep_for(1ms);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

struct Way {
  std::string name;  // of the plugin's, or of what is sent from outside
  int exit_code;
  std::string line;  // what the controller says
  int signal = 0;    // from outside; 0: none
};
const std::vector<Way> ways{{"kill", -SIGKILL, "", SIGKILL},
                            {"quit", -SIGQUIT, "", SIGQUIT},
                            {"alarm", -SIGALRM, "", SIGALRM},
                            {"exit", 3, "called exit(0); the process ends\n"},
                            {"underscore_exit", 3, "called _exit(0); the process ends\n"},
                            {"abort", -SIGABRT, "abort; the process ends\n"},
                            {"segmentation", -SIGSEGV, "segmentation fault at address 0x0; the process ends\n"},
                            {"overflow", -SIGSEGV, "stack overflow at address 0x"}};

// What is wrong with the end of one run, nothing if it is as it has to be; and how long it took until the vehicle knew.
struct Outcome {
  std::string wrong;
  GuardedVehicle::Clock::duration took{};
};

Outcome end_once(const command::TemporaryFolder& folder, const std::string& link, bool helicopter,
                 const std::string& model, const Way& way) {
  GuardedVehicle vehicle(link, helicopter);
  const bool kill = way.signal != 0;
  Process run(tests::guarded_run(folder, vehicle, model, kill ? "none" : way.name));
  std::string wrong;
  const auto expect = [&](bool good, const std::string& what) { wrong += good ? "" : what + "; "; };
  pid_t guardian = 0;
  const auto steered = [&] {
    if (guardian == 0) guardian = tests::find_guardian(run.id());
    return vehicle.is_steered() && guardian != 0;
  };
  expect(vehicle.listen_until(steered), "not steered, or no guardian");
  const std::uint64_t flawed = vehicle.flawed();  // a line echoes until it is opened
  auto gone = GuardedVehicle::Clock::now();
  if (kill) run.signal(way.signal);
  vehicle.leans = true;
  if (!vehicle.listen_until([&] { return vehicle.is_at_rest(); })) return {"no safe: " + run.errors(), {}};
  if (!kill) gone = vehicle.steered_at;
  const int exit_code = run.end();
  expect(exit_code == way.exit_code, "exit code " + std::to_string(exit_code));
  const std::size_t line = run.errors().find("crash: task 'pilot' activation ");
  expect(kill || (line != std::string::npos && run.errors().find(" s: " + way.line, line) != std::string::npos),
         "no line of a crash in '" + run.errors() + "'");
  expect(
      run.errors().find("guardian: the controller is gone without having closed; sent 'safe': ") != std::string::npos,
      "the guardian says nothing");
  expect(run.output().empty(), "it printed a report");
  expect(vehicle.flawed() == flawed, std::to_string(vehicle.flawed() - flawed) + " flawed packets");
  expect(end_of(guardian) == 1, "the guardian did not end");
  return {wrong, vehicle.rested_at - gone};
}

// Again where the machine was so busy that it came late.
std::string end_of_run(const command::TemporaryFolder& folder, const std::string& link, bool helicopter,
                       const std::string& model, const Way& way) {
  Outcome outcome;
  for (int attempt = 0; attempt < 5; ++attempt) {
    outcome = end_once(folder, link, helicopter, model, way);
    if (!outcome.wrong.empty() || outcome.took <= limit) break;
  }
  if (outcome.took > limit) outcome.wrong += "safe came late";
  if (std::getenv("JAROL_TIMES") != nullptr)
    std::cerr << way.name + " over " + link + ": " +
                     std::to_string(std::chrono::duration<double, std::milli>(outcome.took).count()) + " ms\n";
  return outcome.wrong;
}

struct Case {
  std::string link, model;
  bool helicopter = true;
};

// A few at a time.
void try_all(const std::vector<Case>& cases, const std::vector<Way>& of_ways) {
  const command::TemporaryFolder folder;
  // guardians that outlive their controllers become children of this process
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  struct Trial {
    std::string name;
    std::future<std::string> wrong;
  };
  std::vector<Trial> trials;
  const auto look = [&] {
    for (Trial& trial : trials) {
      CAPTURE(trial.name);
      CHECK(trial.wrong.get() == "");
    }
    trials.clear();
  };
  for (const Way& way : of_ways)
    for (const Case& c : cases) {
      trials.push_back({way.name + " over " + c.link + " with " + c.model, std::async(std::launch::async, [&] {
                          return end_of_run(folder, c.link, c.helicopter, c.model, way);
                        })});
      if (trials.size() == 5) look();
    }
  look();
}
}  // namespace

TEST_SUITE("tools/guardian") {
  TEST_CASE("whatever ends a controller, the helicopter gets safe in time, over every link and in every model") {
    std::vector<Case> cases;
    for (const std::string model : {"table", "fixed_priority", "threads"})
      for (const std::string link : {"udp", "udp without peer", "tcp_client", "tcp_server", "serial"})
        cases.push_back({link, model});
    try_all(cases, ways);
  }

  TEST_CASE("so is the submarine, by packets that report the time at which they are sent") {
    try_all({{"udp", "table", false}, {"tcp_server", "threads", false}, {"serial", "fixed_priority", false}},
            {ways[0], ways[5]});
  }

  TEST_CASE("so is a vehicle on a link with a key, by packets that it takes for the controller's") {
    std::vector<Case> cases;
    for (const std::string link : {"udp", "udp without peer", "tcp_client", "tcp_server"})
      for (const bool helicopter : {true, false})
        cases.push_back({link + " with a key", helicopter ? "table" : "threads", helicopter});
    try_all(cases, {ways[0], ways[5]});
  }

  TEST_CASE("a submarine that steers itself when its controller is killed is left alone; given back it gets safe") {
    const command::TemporaryFolder folder;
    prctl(PR_SET_CHILD_SUBREAPER, 1);
    for (const bool given_back : {false, true}) {
      CAPTURE(given_back);
      GuardedVehicle vehicle("udp", false);
      vehicle.steers_itself = false;
      Process run(tests::guarded_run(folder, vehicle, "table", "none"));
      pid_t guardian = 0;
      REQUIRE(vehicle.listen_until([&] {
        guardian = tests::find_guardian(run.id());
        return vehicle.is_steered() && guardian != 0;
      }));
      vehicle.steers_itself = true;
      REQUIRE(vehicle.listen_until([&] { return GuardedVehicle::Clock::now() - vehicle.steered_at > 1s; }));
      if (given_back) {
        vehicle.steers_itself = false;
        REQUIRE(vehicle.listen_until([&] { return GuardedVehicle::Clock::now() - vehicle.steered_at < 20ms; }));
      }
      const std::uint64_t packets = vehicle.packets;
      run.signal(SIGKILL);
      CHECK(run.end() == -SIGKILL);
      CHECK(end_of(guardian) == 1);
      const bool rests = vehicle.listen_until([&] { return vehicle.is_at_rest(); }, given_back ? 30s : 300ms);
      CHECK(rests == given_back);
      CHECK((vehicle.packets == packets) == !given_back);
      const std::string sent = given_back ? "sent 'safe': 25 packets over udp " : "sent 'safe': none over udp ";
      CHECK(run.errors().find(sent) != std::string::npos);
      CHECK((run.errors().find(", as the vehicle there steers itself\n") != std::string::npos) == !given_back);
    }
  }

  TEST_CASE("without a guardian a crash leaves the last command in force, and nobody says otherwise") {
    const command::TemporaryFolder folder;
    GuardedVehicle vehicle("udp", true);
    Process run(tests::guarded_run(folder, vehicle, "table", "none") + " --no-guardian");
    REQUIRE(vehicle.listen_until([&] { return vehicle.is_steered(); }));
    CHECK(tests::find_guardian(run.id()) == 0);
    run.kill();
    CHECK(run.end() == -SIGKILL);
    CHECK(!vehicle.listen_until([&] { return vehicle.is_at_rest(); }, 500ms));
  }

  TEST_CASE("a run that ends in good order sends all there is itself, and its guardian nothing") {
    const command::TemporaryFolder folder;
    for (const std::string model : {"table", "fixed_priority", "threads"})
      for (const std::string link : {"tcp_server", "serial"}) {
        CAPTURE(model + " over " + link);
        GuardedVehicle vehicle(link, true);
        Process run(tests::guarded_run(folder, vehicle, model, "none"));
        REQUIRE(vehicle.listen_until([&] { return vehicle.is_steered(); }));
        const pid_t guardian = tests::find_guardian(run.id());
        CHECK(guardian != 0);
        run.interrupt();
        CHECK(run.end() == 130);
        CHECK(kill(guardian, 0) != 0);  // and no zombie
        const nlohmann::json json = run.json();
        CHECK(json["guardian"] == nlohmann::json{{"ready", true}, {"safe", {"to"}}});
        const std::uint64_t sent = json["links"][0]["counts"]["packets out"];
        vehicle.listen_until([&] { return vehicle.packets > sent; }, 200ms);
        CHECK(vehicle.packets == sent);
        CHECK(run.errors().find("guardian:") == std::string::npos);
      }
  }

  TEST_CASE("a guardian that is killed is missed at once and in the report, and the run goes on") {
    const command::TemporaryFolder folder;
    GuardedVehicle vehicle("udp", true);
    Process run(tests::guarded_run(folder, vehicle, "table", "none"));
    REQUIRE(vehicle.listen_until([&] { return vehicle.is_steered(); }));
    CHECK(kill(tests::find_guardian(run.id()), SIGKILL) == 0);
    const std::string note =
        "note: the guardian is gone; the run goes on, and from now on a crash leaves the last commands in force\n";
    CHECK(run.says(note));
    CHECK(run.errors().find(note) == run.errors().rfind(note));
    run.interrupt();
    CHECK(run.end() == 130);
    CHECK(run.json()["guardian"] ==
          nlohmann::json{{"ready", false}, {"safe", {"to"}}, {"missing", "it was gone before the run ended"}});
  }

  TEST_CASE("signals that end others are nothing to a guardian, which has a session of its own") {
    const command::TemporaryFolder folder;
    GuardedVehicle vehicle("udp", true);
    Process run(tests::guarded_run(folder, vehicle, "table", "none"));
    REQUIRE(vehicle.listen_until([&] { return vehicle.is_steered(); }));
    const pid_t guardian = tests::find_guardian(run.id());
    CHECK(getsid(guardian) == guardian);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGUSR1, SIGTSTP}) kill(guardian, signal);
    run.kill();
    CHECK(vehicle.listen_until([&] { return vehicle.is_at_rest(); }));
  }

  TEST_CASE("a run that follows a killed one at once has its port") {
    const command::TemporaryFolder folder;
    GuardedVehicle vehicle("udp", true);
    const std::string words = tests::guarded_run(folder, vehicle, "table", "none");
    Process first(words);
    REQUIRE(vehicle.listen_until([&] { return vehicle.is_steered(); }));
    first.kill();
    first.end();
    Process second(words);
    REQUIRE(vehicle.listen_until([&] { return vehicle.is_at_rest(); }));
    const auto rested_at = vehicle.rested_at;
    CHECK(vehicle.listen_until([&] { return vehicle.steered_at > rested_at; }));
    second.interrupt();
    CHECK(second.end() == 130);
  }

  TEST_CASE("who never armed its guardian may go as it likes; who did not close is gone") {
    const GuardedVehicle vehicle("udp", true);
    prctl(PR_SET_CHILD_SUBREAPER, 1);
    {
      distributers::Guardian guardian(JAROL_COMMAND);
      guardian.await_ready();
      CHECK(guardian.close());
      CHECK(guardian.close());
    }
    CHECK_THROWS_WITH_AS(distributers::Guardian("/nowhere"), "'/nowhere' does not start: No such file or directory",
                         std::runtime_error);
    distributers::Guardian other("/bin/true");
    CHECK_THROWS_WITH_AS(other.await_ready(), "its process does not answer", std::runtime_error);
  }
}

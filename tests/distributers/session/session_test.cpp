// A session on its own: what it steps, is fed, shows and refuses.
#include "distributers/session/session.h"

#include <doctest/doctest.h>

#include "graph/text/errors.h"
#include "tasks/values/lauv.h"
#include "tests/distributers/all_parts.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;

struct FailsAtThree {
  static constexpr std::string_view summary = "throws at its activation 3";
  struct Out {
    double out = 0;
    static constexpr auto fields() { return describe(field<&Out::out>()); }
  };
  static void run(const Tick& tick, Out& out) {
    if (tick.activation == 3) throw std::runtime_error("three");
    out.out += 1;
  }
};

Session session_of(const std::string& text, SessionOptions options = {}) {
  return {tests::all_parts_with<FailsAtThree>(), std::make_shared<const Source>(Source{"t.yaml", text}),
          std::move(options)};
}

const std::string counting = R"(
graph: t
timing: {}
communicators: {total: {type: double, direction: out, period: 20ms}}
tasks: {count: {type: Counter, period: 10ms, wcet: 1us}, slow: {type: Relay, period: 20ms, let: 15ms, wcet: 1us}}
connections: [count.out -> slow.in, slow.out -> total]
)";

const std::string adding = R"(
graph: t
timing: {period: 10ms}
distributers:
  neptus: {type: LauvOperator, link: {type: udp, listen: 0}}
communicators:
  a: {type: double, direction: in}
  b: {type: double, direction: in, init: 5}
  goal: {channel: neptus.setpoint}
  motion: {type: Motion, direction: in}
tasks:
  sum: {type: Sum, wcet: 1us}
  depth: {type: DepthControl, wcet: 1us}
connections: [a -> sum.a, b -> sum.b, goal -> depth.setpoint, motion -> depth.motion]
)";

const std::string faulty = R"(
graph: t
timing: {period: 10ms}
tasks: {fails: {type: FailsAtThree, wcet: 1us}}
)";
}  // namespace

TEST_SUITE("distributers/session") {
  TEST_CASE("until an output is published it reads as at the start, then as published last, and no sooner") {
    Session session = session_of(counting);
    CHECK(session.value<double>("slow.out") == 0);
    session.run_until(30ms);  // the LET from 0 ended at 15 ms, that from 20 ms has not
    CHECK(session.now() == 30ms);
    CHECK(session.value<double>("count.out") == 2);
    CHECK(session.value<double>("slow.out") == 0);
    session.run_for(10ms);  // 35 ms
    CHECK(session.value<double>("slow.out") == 2);
    CHECK(session.value<double>("total") == 0);
    session.run_for(1ns);  // 40 ms
    CHECK(session.value<double>("total") == 2);
    CHECK(session.report().activations == 8);
  }

  TEST_CASE("what is watched is kept with its instants, from then on") {
    Session session = session_of(counting);
    session.run_until(20ms);
    session.watch("s*.out");
    session.watch("total");
    session.run_until(80ms);
    const auto samples = session.samples<double>("slow.out");
    REQUIRE(samples.size() == 3);
    CHECK(samples[0].instant == 35ms);
    CHECK(samples[0].value == 2);
    CHECK(samples[2].instant == 75ms);
    CHECK(samples[2].value == 6);
    CHECK(session.samples<double>("total").size() == 3);
    CHECK_THROWS_WITH_AS(session.samples<double>("count.out"),
                         "'count.out' is not watched; call watch(\"count.out\") before it is run", NotWatched);
  }

  TEST_CASE("what is fed is taken at the instant reached, once, and goes the way of any value from outside") {
    Session session = session_of(adding, {.fed = {"*"}});
    session.feed("a", 2.0);
    session.run_until(10ms);
    CHECK(session.value<double>("sum.out") == 7);
    session.feed("a", 1.0);
    session.feed("a", 3.0);  // the newest counts
    session.feed("b", 4.0);
    CHECK(session.value<double>("sum.out") == 7);
    session.run_until(10ms + 1ns);
    CHECK(session.value<double>("sum.out") == 7);
    session.feed("neptus.setpoint", tasks::Setpoint{.depth = 3});
    session.run_until(20ms);
    CHECK(session.value<tasks::Setpoint>("goal").depth == 0);
    session.run_until(30ms);
    CHECK(session.value<double>("goal.depth") == 3);
    session.feed("a", std::numeric_limits<double>::infinity());
    session.run_until(60ms);
    CHECK(session.value<double>("a") == 3);
    session.finish();
    CHECK(session.report().non_finite_inputs == 1);
  }

  TEST_CASE("what can't be is refused at the edge, by type") {
    CHECK_THROWS_WITH_AS(session_of(counting, {.workers = 0}), "a run has 1 to 64 workers, not 0", NotExecutable);
    CHECK_THROWS_WITH_AS(session_of(counting, {.workers = 65}), "a run has 1 to 64 workers, not 65", NotExecutable);
    Session session = session_of(adding, {.fed = {"*"}});
    session.run_for(1s);
    CHECK_THROWS_WITH_AS(session.run_for(Duration::max()), "a run has ten years at most, not 9223372036.854775807 s",
                         WrongInstant);
    CHECK_THROWS_WITH_AS(session.run_for(Duration::min()),
                         "a run does not go back: it has reached 1 s, and was to run until -9223372035.854775808 s",
                         WrongInstant);
    session.finish();
    CHECK_THROWS_WITH_AS(session.feed("a", 2.0), "the run is over: it was finished", RunOver);
    CHECK_THROWS_WITH_AS(session.watch("*"), "the run is over: it was finished", RunOver);
    const Session other = std::move(session);
    CHECK(other.now() == 1s);
    CHECK_THROWS_WITH_AS(session.now(), "this session was moved from; use the one that it was moved to", RunOver);
  }

  TEST_CASE("what is not there is refused with what is") {
    Session session = session_of(adding, {.fed = {"a", "neptus"}});
    CHECK_THROWS_WITH_AS(session.value<double>("som.out"),
                         "nothing that is published has the name 'som.out'; did you mean 'sum.out'?; there are: a, b, "
                         "depth.moment, goal, motion, sum.out",
                         UnknownName);
    CHECK_THROWS_WITH_AS(session.value<double>("goal.dept"),
                         "'goal' (Setpoint) has no field 'dept'; did you mean 'depth'?; it has: depth, heading, speed, "
                         "turn, rate, drive, thrust",
                         UnknownName);
    CHECK_THROWS_WITH_AS(session.value<double>("goal.depth."), "'goal.depth' (double) has no field ''; it has: nothing",
                         UnknownName);
    CHECK_THROWS_WITH_AS(session.value<tasks::Setpoint>("goal."),
                         "'goal' (Setpoint) has no field ''; it has: depth, heading, speed, turn, rate, drive, thrust",
                         UnknownName);
    CHECK_THROWS_AS(session.value<double>("goal..depth"), UnknownName);
    CHECK_THROWS_WITH_AS(
        session.watch("x*"),
        "nothing that is published has the name 'x*'; there are: a, b, depth.moment, goal, motion, sum.out",
        UnknownName);
    CHECK_THROWS_WITH_AS(session.feed("neptus.setpiont", tasks::Setpoint{}),
                         "no 'in' communicator, and no channel of one, has the name 'neptus.setpiont'; did you mean "
                         "'neptus.setpoint'?; there are: a, b, goal, neptus.setpoint, motion",
                         UnknownName);
    CHECK_THROWS_WITH_AS(session.true_value("depth of dune"),
                         "no vehicle in this process has the true value 'depth of dune'; there are: nothing",
                         UnknownName);
    CHECK_THROWS_WITH_AS(session_of(adding, {.fed = {"neptun"}}),
                         "no distributer, and no 'in' communicator without a channel, has the name 'neptun'; did you "
                         "mean 'neptus'?; there are: neptus, a, b, motion",
                         UnknownName);
  }

  TEST_CASE("a value of another type is refused with both") {
    Session session = session_of(adding, {.fed = {"a", "neptus"}});
    CHECK_THROWS_WITH_AS(session.value<float>("sum.out"), "'sum.out' is a double, not a float", WrongType);
    CHECK_THROWS_WITH_AS(session.value<double>("goal"), "'goal' is a Setpoint, not a double", WrongType);
    CHECK_THROWS_WITH_AS(session.feed("a", 1), "'a' takes a double, not an int32", WrongType);
    CHECK_THROWS_WITH_AS(session.feed("neptus.setpoint", tasks::Motion{}),
                         "'neptus.setpoint' takes a Setpoint, not a Motion", WrongType);
  }

  TEST_CASE("what comes from elsewhere is not fed") {
    Session session = session_of(adding, {.fed = {"neptus"}});
    CHECK_THROWS_WITH_AS(session.feed("b", 1.0),
                         "'b' is not fed: it has no channel; open the session with .fed = {\"b\"}", NotFed);
    CHECK_THROWS_WITH_AS(session_of(adding),
                         "distributer 'neptus' has a link to what goes on by itself; open the session with "
                         ".real_clock = true, or with .fed = {\"neptus\"} and feed it",
                         NeedsRealClock);
  }

  TEST_CASE("a run does not go back, and goes on after neither its end nor a fault that stops it") {
    Session session = session_of(counting);
    session.run_until(1s);
    CHECK_THROWS_WITH_AS(session.run_until(500ms),
                         "a run does not go back: it has reached 1 s, and was to run until 0.5 s", WrongInstant);
    session.finish();
    CHECK_THROWS_WITH_AS(session.run_until(2s), "the run is over at 1 s: it was finished", RunOver);
    CHECK_THROWS_WITH_AS(session.finish(), "the run was finished before", RunOver);
    CHECK(session.value<double>("count.out") == 99);

    Session stopped = session_of(faulty);
    stopped.run_until(10s);
    CHECK(stopped.report().stopped);
    CHECK(stopped.now() < 10s);
    CHECK_THROWS_WITH_AS(stopped.run_until(10s),
                         "the run is over at 0.03 s: task 'fails' activation 3 at 0.03 s: threw: three", RunOver);
  }

  TEST_CASE("a session that only goes back to a checkpoint is judged as one that has run until then") {
    const std::string judged = counting + "expect: [count.out < 49.5, final(count.out) within 0.5 of 49]\n";
    Session first = session_of(judged);
    first.run_until(500ms);
    const Checkpoint here = first.checkpoint();
    first.run_until(1s);
    Session second = session_of(judged), third = session_of(judged);
    second.restore(here);
    third.restore(here);
    CHECK(second.now() == 500ms);
    const auto lines = [](const RunVerdict& verdict) {
      std::string text;
      for (const Verdict& v : verdict.expectations)
        text += v.condition + ": " + std::to_string(static_cast<int>(v.outcome)) + " " + v.reached_text + " " + v.why +
                "\n";
      return text;
    };
    Session until = session_of(judged);
    until.run_until(500ms);
    const RunVerdict should = until.finish(), is = second.finish();
    CHECK(lines(is) == lines(should));
    CHECK(!is.is_negative());
    CHECK(second.report().digest == until.report().digest);
    // a session back at an instant after it has been further is judged until there, too
    first.restore(here);
    CHECK(lines(first.finish()) == lines(should));
    // and one that goes on, to where it went
    third.run_until(1s);
    CHECK(third.finish().is_negative());
  }

  TEST_CASE("on the real clock it takes the time that it says, and what it reached is what it would have reached") {
    std::vector<std::string> notes;
    // a machine that is busy may hold it up
    Session real = session_of(counting, {.set = {"tasks.count.on_fault=hold", "tasks.slow.on_fault=hold"},
                                         .real_clock = true,
                                         .force = true,
                                         .note = [&](const std::string& note) { notes.push_back(note); }});
    Session logical = session_of(counting);
    logical.run_until(100ms);
    const auto begin = std::chrono::steady_clock::now();
    real.run_until(40ms);
    real.run_until(100ms);
    CHECK(std::chrono::steady_clock::now() - begin > 80ms);  // its last instant is 90 ms
    CHECK(real.now() == 100ms);
    if (real.report().fault_count == 0) CHECK(real.value<double>("count.out") == logical.value<double>("count.out"));
    real.finish();
    CHECK_THROWS_WITH_AS(
        session_of(counting + "platform: {policy: edf}\n", {.real_clock = true}),
        "'t.yaml' has the policy 'edf'; the real clock executes 'table' and 'fixed_priority'; choose one by .set "
        "platform.policy=table",
        NotExecutable);
    CHECK_THROWS_WITH_AS(
        session_of(counting, {.set = {"tasks.count.wcet=11ms"}, .real_clock = true}),
        "'t.yaml' is not schedulable: the tasks need more than the whole core; 'jarol check' says more, "
        ".force runs it all the same",
        NotExecutable);
    notes.clear();
    session_of(counting, {.set = {"tasks.count.wcet=11ms"},
                          .real_clock = true,
                          .force = true,
                          .note = [&](const std::string& note) { notes.push_back(note); }});
    CHECK(notes == std::vector<std::string>{});
    CHECK_THROWS_WITH_AS(session_of(counting, {.workers = 2, .real_clock = true}),
                         ".workers belongs to the virtual clock; the real one goes by 'platform'", NotExecutable);
    CHECK_THROWS_WITH_AS(session_of(counting, {.real_clock = true, .execution = "wcet"}),
                         ".execution belongs to the virtual clock; on the real one activations take the time that they "
                         "take",
                         InputError);
  }

  TEST_CASE("all that is wrong with a graph is one SpecError, as on the command line") {
    CHECK_THROWS_WITH_AS(session_of("graph: t\ntasks: {a: {type: Counter, period: 10}}\nchains: 3\n"),
                         "t.yaml:2:36: error: task 'a' key 'period': '10' has no unit; write one of h, min, s, ms, us "
                         "or ns, as in 10ms\n"
                         "  tasks: {a: {type: Counter, period: 10}}\n"
                         "                                     ^\n"
                         "t.yaml:3:9: error: 'chains' needs a mapping of names, not a scalar\n"
                         "  chains: 3\n"
                         "          ^",
                         SpecError);
  }

  TEST_CASE("sessions side by side are runs of their own, and one can be moved") {
    Session first = session_of(counting), second = session_of(counting);
    first.run_until(1s);
    second.run_until(500ms);
    CHECK(first.report().digest != second.report().digest);
    Session moved = std::move(second);
    moved.run_until(1s);
    CHECK(moved.report().digest == first.report().digest);
  }
}

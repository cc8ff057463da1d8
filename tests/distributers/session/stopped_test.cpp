// The verdict on a session that did not come to its end.
#include <doctest/doctest.h>

#include "distributers/session/session.h"
#include "tests/distributers/all_parts.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;

struct FailsAtFive {
  static constexpr std::string_view summary = "throws at its activation 5";
  struct Out {
    double out = 0;
    static constexpr auto fields() { return describe(field<&Out::out>()); }
  };
  static void run(const Tick& tick, Out& out) {
    if (tick.activation == 5) throw std::runtime_error("five");
    out.out += 1;
  }
};

Session failing() {
  const std::string text =
      "graph: t\ntiming: {period: 10ms}\ntasks: {a: {type: FailsAtFive, wcet: 1us}}\n"
      "expect: [final(a.out) > 2, a.out < 9]\n";
  return {tests::all_parts_with<FailsAtFive>(), std::make_shared<const Source>(Source{"t.yaml", text})};
}

const std::string what_stopped = "task 'a' activation 5 at 0.05 s: threw: five";
}  // namespace

TEST_SUITE("distributers/session/stopped") {
  TEST_CASE("the verdict on a session that a fault stops is negative, and says which fault") {
    Session whole = failing(), stopped = failing();
    whole.run_until(50ms);
    CHECK_FALSE(whole.finish().is_negative());
    stopped.run_until(1s);
    const RunVerdict verdict = stopped.finish();
    CHECK(verdict.is_negative());
    CHECK(verdict.stopped == what_stopped);
    CHECK(verdict.expectations[0].why == "the run ended at 0.05 s, and was to go on until 1 s");
  }

  TEST_CASE("a session that goes back to where a fault had stopped it is not judged as one that came to its end") {
    Session stopped = failing(), again = failing();
    stopped.run_until(1s);
    again.restore(stopped.checkpoint());
    const RunVerdict verdict = again.finish();
    CHECK(verdict.is_negative());
    CHECK(verdict.stopped == what_stopped);
    for (const Verdict& v : verdict.expectations) {
      CHECK(v.outcome == Verdict::Outcome::not_judged);
      CHECK(v.why == "a fault ended the run at 0.05 s");
    }
  }

  TEST_CASE("the verdict on a session that goes back before its fault, and is not run into it again, is a good one") {
    Session session = failing();
    session.run_until(30ms);
    const Checkpoint before = session.checkpoint();
    session.run_until(1s);
    session.restore(before);
    CHECK_FALSE(session.finish().is_negative());
  }

  TEST_CASE("the verdict on a session that has heard nothing from its vehicle is negative") {
    const std::string text =
        "graph: t\ntiming: {period: 10ms}\ndistributers: {dune: {type: LauvVehicle, link: {type: udp, listen: 0}}}\n"
        "communicators: {motion: {channel: dune.motion}, hand: {type: Actuation, direction: in}}\n"
        "tasks: {forward: {type: LauvForward, wcet: 1us}}\nconnections: [motion -> forward.motion, hand -> "
        "forward.actuation]\n";
    Session session(tests::all_parts_with<FailsAtFive>(), std::make_shared<const Source>(Source{"t.yaml", text}),
                    {.real_clock = true, .force = true});
    session.run_until(20ms);
    const RunVerdict verdict = session.finish();
    CHECK(verdict.is_negative());
    CHECK(verdict.stopped == "nothing came from the vehicle of 'dune'");
  }
}

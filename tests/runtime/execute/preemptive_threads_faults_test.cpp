// Faults of tasks on several threads in real time.
#include <doctest/doctest.h>

#include "tests/runtime/run_on_threads.h"

namespace {
using namespace jarol;
using namespace jarol::tests::threads;
using tests::lines_of;
}  // namespace

TEST_SUITE("runtime/preemptive_threads_faults") {
  TEST_CASE("faults, what they keep back and what they undo are those of the virtual clock") {
    for (const std::string on_fault : {"hold", "skip", "restart", "stop"}) {
      const std::string text = R"(graph: t
timing: {period: 20ms}
tasks:
  source: {type: Counter, core: ANY}
  flow: {type: Faulty, core: ANY, on_fault: )" +
                               on_fault +
                               R"(, parameters: {faulty: 2}}
  timed: {type: Faulty, core: ANY, let: 10ms, on_fault: )" +
                               on_fault + ", parameters: {faulty: " + (on_fault == "stop" ? "3" : "1") + R"(}}
  reader: {type: Sum, let: 20ms}
connections: [source.out -> flow.in, flow.out -> timed.in, timed.out -> reader.a, flow.out -> reader.b]
)";
      CAPTURE(on_fault);
      for (const Mode& mode : modes) {
        CAPTURE(mode.name);
        const RealRun r = run_undisturbed(on(mode, text), 120ms);
        const tests::Run should = run_virtual(on(table_1, text), 120ms, r.times);
        CHECK(should.report.fault_count == (on_fault == "stop" ? 1 : 2));
        CHECK(text_of(r.report.faults) == text_of(should.report.faults));
        CHECK(r.report.digest == should.report.digest);
        CHECK(r.report.activations == should.report.activations);
        CHECK(r.report.stopped == should.report.stopped);
        CHECK(r.report.simulated == should.report.simulated);
        CHECK(sorted(r.lines) == sorted(should.lines));
      }
    }
  }

  TEST_CASE("a task that is late publishes what one that throws does: nothing, and its state is undone") {
    for (const std::string let : {", on_fault: hold", ", let: 10ms, on_fault: hold", ", on_fault: restart"}) {
      const auto text = [&](const std::string& lasts) {
        return "graph: t\ntiming: {period: 20ms}\ntasks:\n  source: {type: Counter, core: ANY}\n  s: {type: Faulty, "
               "core: ANY" +
               let + ", parameters: {faulty: 2, lasts: " + lasts +
               "}}\n  r: {type: Relay, core: ANY, let: 20ms, offset: 10ms}\nconnections: [source.out -> s.in, s.out -> "
               "r.in]\n";
      };
      for (const Mode& mode : modes) {
        CAPTURE(let);
        CAPTURE(mode.name);
        const RealRun r = run_undisturbed(on(mode, text("14ms")), 160ms, "late: s 2");
        const tests::Run should = run_virtual(on(table_1, text("0ms")), 160ms, r.times);
        REQUIRE(should.report.fault_count == 1);
        REQUIRE(r.report.fault_count == 1);
        CHECK(r.late == 1);
        CHECK(r.left_out == 0);
        CHECK(r.report.faults[0].instant == should.report.faults[0].instant);
        CHECK(r.report.faults[0].cause.substr(0, 6) == "late: ");
        CHECK(r.report.digest == should.report.digest);
        CHECK(sorted(r.lines) == sorted(should.lines));
      }
    }
  }

  TEST_CASE("releases while a late one still runs are left out, each a fault; more urgent tasks go on meanwhile") {
    const std::string text = R"(graph: t
tasks:
  other: {type: Accumulate, period: 10ms, on_fault: hold, core: 0}
  s: {type: Faulty, period: 20ms, let: 20ms, on_fault: skip, core: 0, parameters: {faulty: 2, lasts: 70ms}}
connections: [s.out -> s.in, s.out -> other.in]
)";
    for (const Mode& mode : modes) {
      CAPTURE(mode.name);
      const bool waits = mode.name == table_2.name;  // a table does not preempt
      const RealRun r = run_undisturbed(on(mode, text), 180ms,
                                        waits ? "late: other 5, s 2; left out: other 10, other 11, other 6, other 7, "
                                                "other 8, other 9, s 3, s 4, s 5"
                                              : "late: s 2; left out: s 3, s 4, s 5");
      CHECK(r.late == (waits ? 2 : 1));
      CHECK(r.left_out == (waits ? 9 : 3));
      std::string faults;
      for (const Fault& fault : r.report.faults)
        if (fault.task == "s") faults += to_text(fault) + "\n";
      CHECK(faults ==
            "task 's' activation 2 at 0.06 s: late: had not ended when it was due, deadline 20ms\n"
            "task 's' activation 3 at 0.08 s: left out: an activation before it still ran at its release\n"
            "task 's' activation 4 at 0.1 s: left out: an activation before it still ran at its release\n"
            "task 's' activation 5 at 0.12 s: left out: an activation before it still ran at its release\n");
      CHECK(lines_of(r, "s.out") == "20ms s.out=999; 40ms s.out=2999; 140ms s.out=5999; 160ms s.out=9999");
      // one that has not even begun when it is due leaves no trace in the state
      const std::string before =
          "0ns other.out=-1; 10ms other.out=-2; 20ms other.out=997; 30ms other.out=1996; 40ms other.out=4995; ";
      if (waits)
        CHECK(lines_of(r, "other.out") ==
              before +
                  "120ms other.out=7994; 130ms other.out=10993; 140ms other.out=16992; 150ms other.out=22991; "
                  "160ms other.out=32990; 170ms other.out=42989");
      else
        CHECK(lines_of(r, "other.out").find(before + "50ms other.out=7994; 60ms other.out=10993; ") == 0);
      CHECK(r.lines.size() == (waits ? 11 : 18) + 4);
    }
  }
}

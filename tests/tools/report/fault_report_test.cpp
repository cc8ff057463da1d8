#include "tools/report/fault_report.h"

#include <doctest/doctest.h>

#include "runtime/run/fault_text.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;

const std::string hint =
    "note: 'on_fault: stop', the default, ended the run there; with 'hold' what is late keeps its last outputs and the "
    "run goes on, as with --set tasks.fins.on_fault=hold\n";

Report report_of(const std::string& cause, bool stopped) {
  Report report;
  report.add({"depth", 1, 20ms, "output 'out' is inf"});
  report.add({"fins", 2, 40ms, cause});
  report.stopped = stopped;
  return report;
}
}  // namespace

TEST_SUITE("tools/fault_report") {
  TEST_CASE("where what came late ended the run, it is said how the run goes on in spite of that") {
    const std::string first = "fault: task 'depth' activation 1 at 0.02 s: output 'out' is inf\n";
    for (const std::string& cause : {late_text(12ms, 10ms), std::string(overrun_text)}) {
      const std::string faults = first + "fault: task 'fins' activation 2 at 0.04 s: " + cause + "\n";
      CHECK(tools::fault_report(report_of(cause, true)) == faults + hint);
      CHECK(tools::fault_report(report_of(cause, false)) == faults);
    }
    CHECK(tools::fault_report(report_of("threw: no", true)) ==
          first + "fault: task 'fins' activation 2 at 0.04 s: threw: no\n");
  }
}

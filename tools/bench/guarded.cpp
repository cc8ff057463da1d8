#include "tools/bench/guarded.h"

#include <algorithm>

#include "runtime/dispatch/task_guard.h"
#include "runtime/execute/executor.h"
#include "tools/bench/graphs.h"
#include "tools/bench/timing.h"
#include "tools/commands/run/crash_line.h"

namespace jarol::bench {

Figure measure_guard(const std::string& name, int repeats) {
  constexpr int tasks = 10;
  constexpr auto slice = std::chrono::milliseconds(10);  // with a period of 1 ms
  const Graph graph = graph_of(chain(tasks, same_rate));
  // what tasks call is looked up now: under guard that would be a write
  Executor(graph, {}, {}).run_until(slice);
  // its handler lets threads wait that write meanwhile
  const tools::CrashLine crash_line(graph);
  TaskGuard guard;
  Executor executor({graph, Spacing::pages}, {}, {.guard = &guard});
  Duration until = slice;
  executor.run_until(until);  // pages are touched, and regions found
  // the goal is absolute: the floor is its unit, one microsecond
  Figure figure{name, 1e300, "us", 1, 0, 2000, "activation with --guard / 1 us"};
  for (int i = 0; i < std::max(1, repeats / 4); ++i) {
    until += slice;
    const double seconds = seconds_of([&] { executor.run_until(until); });
    figure.value = std::min(figure.value, 1e6 * seconds / (tasks * 10));
  }
  figure.ratio = figure.value / figure.floor;
  return figure;
}

}  // namespace jarol::bench

// How figures are measured: beside their floor, in turn, in one process.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "runtime/execute/executor.h"
#include "tools/bench/figures.h"

namespace jarol::bench {

double seconds_of(const std::function<void()>& work);

/// The sample, in us, that a part of all samples does not exceed. Reorders them.
double microseconds_at(double part, std::vector<Duration>& samples);

/// Takes results, so that no floor is optimised away.
void keep(double result);

/// Runs a graph slice by slice and reports the nanoseconds of one activation.
class GraphRun {
 public:
  GraphRun(const std::string& text, bool digest, Duration slice, std::size_t workers = 1);
  double nanoseconds();

 private:
  Graph graph_;
  Executor executor_;
  Duration slice_;
  Duration until_{};
};

/// Interleaves the two and takes the minimum of each: what neighbours on the machine add is left out.
Figure compare(std::string name, std::string text, double goal, int repeats, const std::function<double()>& value,
               const std::function<double()>& floor);

/// The same by medians: what a second processor gives varies with the neighbours on the machine.
Figure compare_medians(std::string name, std::string text, double goal, int repeats,
                       const std::function<double()>& value, const std::function<double()>& floor);

}  // namespace jarol::bench

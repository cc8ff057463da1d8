// The figures of `jarol bench`: each measured beside its floor, in turn, in one process.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace jarol::bench {

struct Figure {
  std::string name;
  double value = 0;
  std::string unit;
  double floor = 0;
  double ratio = 0;
  double goal = 0;   // of the ratio, at most
  std::string text;  // what is compared with what
};

/// What can be measured, in its order.
std::vector<std::string> figure_names();

/// Of those, what runs graphs of Jarol's source tree: at its root alone.
bool is_of_tree(const std::string& name);

/// Measures one figure; `repeats` interleaved repeats, of which the least counts.
Figure measure(const std::string& name, int repeats);

}  // namespace jarol::bench

// Random graphs to try the analysis with, the same for the same seed everywhere.
#pragma once

#include <cstdint>
#include <string>

namespace jarol::analysis {

struct Generation {
  std::string kind = "waters";  // or "uunifast"
  std::uint64_t seed = 0;
  int tasks = 20;
  double utilisation = 0.6;  // of all cores together
  int cores = 1;
  std::string policy = "fixed_priority";
};

/// One graph as YAML. `waters`: periods, their shares and the spread of execution times as in the automotive benchmarks
/// of Kramer, Ziegenbein, Hamann 2015, with connections between tasks; `uunifast`: utilisations spread evenly (Bini,
/// Buttazzo 2005), periods evenly over the logarithm from 1 ms to 1 s.
std::string generate_graph(const Generation& generation);

}  // namespace jarol::analysis

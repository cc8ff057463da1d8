// The graphs that the benchmarks run, as text.
#pragma once

#include <functional>
#include <string>

#include "graph/model/graph.h"

namespace jarol::bench {

Graph graph_of(const std::string& text);

/// Gives the keys of the i-th task: its timing.
using Keys = std::function<std::string(int)>;

std::string same_rate(int i);
/// 1, 2, 5 and 10 ms in turn.
std::string four_rates(int i);
/// The same with a LET of half the period.
std::string four_rates_let(int i);

/// A chain: a source and stages.
std::string chain(int length, const Keys& keys);
/// One source, all others read it.
std::string fan(int readers);
/// Tasks that nobody reads, whose periods of 9 to 89 ms have little in common.
std::string scattered(int count);
/// A source and tasks of two inputs each, one of them from the task before.
std::string sums(int count);
/// A source and `depth` layers of `width` tasks, each fed by the one above.
std::string layers(int depth, int width, std::uint32_t rounds);
/// Layers of tasks with two inputs each, from any tasks of the layer above and of the one above that.
std::string meshed(int depth, int width);

}  // namespace jarol::bench

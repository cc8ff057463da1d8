#include "tools/commands/check/chain_lines.h"

#include <fmt/format.h>

#include "graph/model/deadlines.h"
#include "tools/commands/check/check_words.h"

namespace jarol::tools {
namespace {

// Of bounds alone it is not known.
std::string jitter_text(const analysis::ChainLatency& latency) {
  return latency.exact ? duration_text(latency.jitter) : "-";
}

// The phase that a loop through the chain loses at its crossover: the delay from read to output, and half a period that
// the output is held (Franklin, Powell, Workman 1998).
std::string control_view(const Graph& graph, const analysis::CheckedChain& c) {
  const End& last = c.chain.path.back();
  const Duration period =
      last.kind == End::Kind::task ? graph.tasks[last.index].period : graph.communicators[last.index].period;
  const double delay = static_cast<double>(c.latency.max_reduced.count()) * 1e-9,
               held = 0.5e-9 * static_cast<double>(period.count());
  return fmt::format("    at {:.4g} rad/s: delay {}, jitter {}, held for {}: {:.1f} deg of phase lost\n",
                     *c.chain.crossover, duration_text(c.latency.max_reduced), jitter_text(c.latency),
                     duration_text(period), *c.chain.crossover * (delay + held) * 180 / 3.14159265358979323846);
}

}  // namespace

std::string late_outs(const Graph& graph) {
  if (graph.platform.phasing == Phasing::any) return "";  // nobody knows what runs at that instant
  std::string text;
  for (const Connection& c : graph.connections) {
    if (c.from.kind != End::Kind::task || c.to.kind != End::Kind::communicator) continue;
    const Task& producer = graph.tasks[c.from.index];
    const Communicator& out = graph.communicators[c.to.index];
    if (producer.let || min_distance(producer.period, producer.offset, out.period, out.offset) !=
                            min_distance(producer.period, Duration{}, out.period, Duration{}))
      continue;
    text += fmt::format(
        "  note: '{}' reads at the very instant at which '{}' runs, and so one period late; give it an 'offset'\n",
        out.name, producer.name);
  }
  return text;
}

std::string chain_lines(const CheckReport& r) {
  std::string text;
  for (const analysis::CheckedChain& c : r.chains) {
    const analysis::ChainLatency& m = c.latency;
    text += fmt::format("  chain {}: reaction {} to {}, data age at most {}, jitter {}{}\n", c.chain.name,
                        m.exact ? duration_text(m.min_reaction) : "-", duration_text(m.max_reaction),
                        duration_text(m.max_age), jitter_text(m), m.exact ? "" : " (upper bounds)");
    if (m.exact) {
      std::string hops;
      for (std::size_t i = 0; i < c.chain.path.size(); ++i) {
        const End& end = c.chain.path[i];
        hops += fmt::format(
            "{}{} {}", i == 0 ? "" : ", ",
            end.kind == End::Kind::task ? r.graph->tasks[end.index].name : r.graph->communicators[end.index].name,
            duration_text(m.at[i + 1] - m.at[i]));
      }
      text += fmt::format("    slowest way from {}: {}\n", duration_text(m.at.front()), hops);
    }
    if (c.chain.crossover) text += control_view(*r.graph, c);
    for (const std::string& broken : analysis::broken_limits(c.chain, m))
      text += (m.exact ? "    LIMIT BROKEN: " : "    LIMIT MAY BE BROKEN, by upper bounds: ") + broken + "\n";
  }
  return text;
}

}  // namespace jarol::tools

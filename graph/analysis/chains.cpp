#include "graph/analysis/chains.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "graph/language/quantities.h"

namespace jarol::analysis {
namespace {

// A point of logical time: the instant, and the step within it (specs/running.md, "An instant").
struct Point {
  Duration instant;
  int step;
};

// What reads and publishes with a period.
struct Hop {
  Duration period, offset, let;
  int read_step, publish_step;

  Point read(std::int64_t k) const { return {offset + k * period, read_step}; }
  Point publish(std::int64_t k) const { return {offset + k * period + let, publish_step}; }

  // The first activation that reads what was published at a point; who reads in the step of its producer follows it.
  std::int64_t first_after(Point p) const {
    const Duration earliest = p.instant + Duration(p.step > read_step ? 1 : 0);
    if (earliest <= offset) return 0;
    return (earliest - offset + period - Duration(1)) / period;
  }
  // The last activation whose output can be read at a point, or a negative one.
  std::int64_t last_before(Point p) const {
    const Duration latest = p.instant - Duration(p.step < publish_step ? 1 : 0) - let - offset;
    return latest < Duration{} ? -1 : latest / period;
  }
};

Hop hop_of(const Graph& graph, const End& end) {
  if (end.kind == End::Kind::communicator) {
    const Communicator& c = graph.communicators[end.index];
    const int step = c.direction == Direction::out ? 2 : 3;
    return {c.period, c.offset, Duration{}, step, step};
  }
  const Task& t = graph.tasks[end.index];
  return {t.period, t.offset, t.let.value_or(Duration{}), 4, t.let ? 1 : 4};
}

// The activation of the last hop that first shows what activation k of the first read.
std::int64_t forward(const std::vector<Hop>& hops, std::int64_t k, std::vector<Duration>* at = nullptr) {
  if (at != nullptr) at->assign(1, hops.front().read(k).instant);
  for (std::size_t i = 0; i < hops.size(); ++i) {
    if (i > 0) k = hops[i].first_after(hops[i - 1].publish(k));
    if (at != nullptr) at->push_back(hops[i].publish(k).instant);
  }
  return k;
}

// The activation of the first hop on which activation k of the last one rests, or a negative one.
std::int64_t backward(const std::vector<Hop>& hops, std::int64_t k) {
  for (std::size_t i = hops.size() - 1; i > 0 && k >= 0; --i) k = hops[i - 1].last_before(hops[i].read(k));
  return k;
}

}  // namespace

ChainLatency latency_of(const Graph& graph, const std::vector<End>& path, Budget& budget) {
  constexpr std::int64_t max_activations = 2'000'000;
  std::vector<Hop> hops;
  for (const End& end : path) hops.push_back(hop_of(graph, end));
  ChainLatency result;
  Wide lcm = 1, bound = 0, start = 0;
  for (const Hop& h : hops) {
    const std::int64_t period = h.period.count();
    bound += (h.period + h.let).count();
    start += (h.offset + h.period + h.let).count();
    const Wide next = lcm / std::gcd(static_cast<std::int64_t>(lcm), period) * period;
    lcm = std::min<Wide>(next, static_cast<Wide>(1) << 62);
  }
  result.bound = saturated(bound);
  const Hop &first = hops.front(), &last = hops.back();
  // how far apart the hops are is not known
  const bool open = graph.platform.phasing == Phasing::any;
  // the latest instant that is looked at is before that
  const bool fits = 2 * (start + lcm) + bound <= std::numeric_limits<std::int64_t>::max();
  const Wide reads = lcm / first.period.count(), outputs = lcm / last.period.count();
  const auto steps = static_cast<Wide>(hops.size()) * (reads + outputs);
  const bool few = reads <= max_activations && outputs <= max_activations;
  if (open || !fits || !few || steps > budget.left) {
    result.exact = false;
    result.max_reaction = result.max_reduced = result.max_age = result.max_reduced_age = result.bound;
    return result;
  }
  budget.spend(static_cast<std::uint64_t>(steps));
  // forward, for every read of one repetition once all offsets are behind
  const Duration behind(static_cast<std::int64_t>(start));
  const std::int64_t from = behind / first.period + 1, to = from + static_cast<std::int64_t>(reads);
  result.min_reaction = Duration::max();
  std::int64_t slowest = from;
  for (std::int64_t k = from; k < to; ++k) {
    const Duration out = last.publish(forward(hops, k)).instant;
    const Duration reduced = out - first.read(k).instant;
    result.min_reaction = std::min(result.min_reaction, reduced);
    if (reduced > result.max_reduced) slowest = k;
    result.max_reduced = std::max(result.max_reduced, reduced);
    result.max_reaction = std::max(result.max_reaction, out - first.read(k - 1).instant);
  }
  // backward, for every output of one repetition: it is valid until the next one that rests on another read
  const std::int64_t begin = (2 * behind) / last.period + 1, end = begin + static_cast<std::int64_t>(outputs);
  for (std::int64_t k = begin; k < end; ++k) {
    const std::int64_t read = backward(hops, k);
    if (read < 0) continue;
    result.max_reduced_age = std::max(result.max_reduced_age, last.publish(k).instant - first.read(read).instant);
    result.max_age = std::max(result.max_age, last.publish(k + 1).instant - first.read(read).instant);
  }
  result.jitter = result.max_reduced - result.min_reaction;
  forward(hops, slowest, &result.at);
  return result;
}

std::vector<std::string> broken_limits(const Chain& chain, const ChainLatency& latency) {
  std::vector<std::string> broken;
  const auto compare = [&](const char* what, Duration is, const std::optional<Duration>& limit) {
    if (limit && is > *limit) broken.push_back(what + (" " + duration_text(is)) + " over " + duration_text(*limit));
  };
  compare("reaction", latency.max_reaction, chain.reaction);
  compare("data age", latency.max_age, chain.age);
  return broken;
}

}  // namespace jarol::analysis

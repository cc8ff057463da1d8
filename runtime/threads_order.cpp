#include "runtime/threads_order.h"

#include <algorithm>
#include <functional>
#include <queue>

namespace jarol {
namespace {

class Ordering {
 public:
  explicit Ordering(const Graph& graph)
      : graph_(graph),
        feeds_(graph.tasks.size()),
        fed_by_(graph.tasks.size()),
        waits_for_(graph.tasks.size(), 0),
        ordered_(graph.tasks.size(), false) {
    for (const Connection& c : graph.connections) {
      if (c.from.kind != End::Kind::task || c.to.kind != End::Kind::task || c.from.index == c.to.index) continue;
      feeds_[c.from.index].push_back(c.to.index);
      fed_by_[c.to.index].push_back(c.from.index);
      ++waits_for_[c.to.index];
    }
  }

  std::vector<std::size_t> run() {
    for (std::size_t i = 0; i < waits_for_.size(); ++i)
      if (waits_for_[i] == 0) ready_.push(i);
    while (order_.size() < waits_for_.size()) {
      if (ready_.empty()) ready_.push(entry_of_a_cycle());
      const std::size_t i = ready_.top();
      ready_.pop();
      order_.push_back(i);
      ordered_[i] = true;
      for (const std::size_t next : feeds_[i])
        if (--waits_for_[next] == 0 && !ordered_[next]) ready_.push(next);
    }
    return std::move(order_);
  }

 private:
  // Tasks yet to be ordered whose outputs come to this one, on whatever way.
  std::vector<bool> upstream_of(std::size_t task) const {
    std::vector<bool> upstream(ordered_.size(), false);
    std::vector<std::size_t> left{task};
    while (!left.empty()) {
      const std::size_t at = left.back();
      left.pop_back();
      for (const std::size_t i : fed_by_[at])
        if (!ordered_[i] && !upstream[i]) {
          upstream[i] = true;
          left.push_back(i);
        }
    }
    return upstream;
  }

  // What this one waits for and does not keep waiting; itself if there is no such.
  std::size_t outside_before(std::size_t task) const {
    const std::vector<bool> upstream = upstream_of(task);
    for (std::size_t i = 0; i < upstream.size(); ++i)
      if (upstream[i] && !upstream_of(i)[task]) return i;
    return task;
  }

  // What feeds this one without a LET; itself if there is no such.
  std::size_t flow_before(std::size_t task) const {
    for (const std::size_t i : fed_by_[task])
      if (!ordered_[i] && !graph_.tasks[i].let) return i;
    return task;
  }

  // Where all that are left wait: of cycles that nothing outside of them feeds, a task that only LET tasks feed.
  std::size_t entry_of_a_cycle() const {
    auto at = static_cast<std::size_t>(std::find(ordered_.begin(), ordered_.end(), false) - ordered_.begin());
    for (std::size_t before; (before = outside_before(at)) != at;) at = before;
    for (std::size_t before; (before = flow_before(at)) != at;) at = before;  // without LETs there is no cycle
    return at;
  }

  const Graph& graph_;
  std::vector<std::vector<std::size_t>> feeds_, fed_by_;
  std::vector<std::size_t> waits_for_;
  std::vector<bool> ordered_;
  // tasks are in order of name, so the least index is the least name
  std::priority_queue<std::size_t, std::vector<std::size_t>, std::greater<>> ready_;
  std::vector<std::size_t> order_;
};

}  // namespace

std::vector<std::size_t> threads_order(const Graph& graph) { return Ordering(graph).run(); }

}  // namespace jarol

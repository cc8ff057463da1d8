#include "runtime/jarol/threads_order.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>

namespace jarol {
namespace {

using Edges = std::vector<std::vector<std::size_t>>;  // per task

// Tasks that wait for each other, among those that a task waits for and it (Tarjan 1972). Components come after all
// that they wait for.
class Components {
 public:
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  Components(const Edges& fed_by, const std::vector<bool>& ordered, std::size_t task)
      : fed_by_(fed_by), ordered_(ordered), index_(fed_by.size(), none), low_(index_), component_(index_) {
    visit(task);
    while (!path_.empty()) {
      const std::size_t at = path_.back().task;
      if (path_.back().next < fed_by_[at].size()) {
        const std::size_t i = fed_by_[at][path_.back().next++];
        if (ordered_[i]) continue;
        if (index_[i] == none)
          visit(i);
        else if (component_[i] == none)
          low_[at] = std::min(low_[at], index_[i]);
      } else {
        path_.pop_back();
        if (!path_.empty()) low_[path_.back().task] = std::min(low_[path_.back().task], low_[at]);
        if (low_[at] == index_[at]) close(at);
      }
    }
  }

  // The least task that this one waits for and does not keep waiting; none if there is no such.
  std::size_t outside_before(std::size_t task) const { return outside_[component_[task]]; }

 private:
  struct Step {
    std::size_t task, next;  // of what feeds it
  };

  void visit(std::size_t task) {
    index_[task] = low_[task] = visited_++;
    open_.push_back(task);
    path_.push_back({task, 0});
  }

  void close(std::size_t root) {
    const auto first = std::find(open_.rbegin(), open_.rend(), root).base() - 1;
    const std::size_t component = least_.size();
    for (auto i = first; i != open_.end(); ++i) component_[*i] = component;
    std::size_t outside = none;
    for (auto i = first; i != open_.end(); ++i)
      for (const std::size_t before : fed_by_[*i]) {
        if (ordered_[before] || component_[before] == component) continue;
        outside = std::min({outside, least_[component_[before]], outside_[component_[before]]});
      }
    least_.push_back(*std::min_element(first, open_.end()));
    outside_.push_back(outside);
    open_.erase(first, open_.end());
  }

  const Edges& fed_by_;
  const std::vector<bool>& ordered_;
  std::size_t visited_ = 0;
  std::vector<std::size_t> index_, low_, component_;  // per task
  std::vector<std::size_t> open_;                     // visited, their component not closed
  std::vector<Step> path_;
  std::vector<std::size_t> least_, outside_;  // per component: its first task, and the first of those it waits for
};

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
  // What feeds this one without a LET; itself if there is no such.
  std::size_t flow_before(std::size_t task) const {
    for (const std::size_t i : fed_by_[task])
      if (!ordered_[i] && !graph_.tasks[i].let) return i;
    return task;
  }

  // Where all that are left wait: of cycles that nothing outside of them feeds, a task that only LET tasks feed.
  std::size_t entry_of_a_cycle() const {
    auto at = static_cast<std::size_t>(std::find(ordered_.begin(), ordered_.end(), false) - ordered_.begin());
    const Components components(fed_by_, ordered_, at);
    for (std::size_t before; (before = components.outside_before(at)) != Components::none;) at = before;
    for (std::size_t before; (before = flow_before(at)) != at;) at = before;  // without LETs there is no cycle
    return at;
  }

  const Graph& graph_;
  Edges feeds_, fed_by_;
  std::vector<std::size_t> waits_for_;
  std::vector<bool> ordered_;
  // tasks are in order of name, so the least index is the least name
  std::priority_queue<std::size_t, std::vector<std::size_t>, std::greater<>> ready_;
  std::vector<std::size_t> order_;
};

}  // namespace

std::vector<std::size_t> threads_order(const Graph& graph) { return Ordering(graph).run(); }

}  // namespace jarol

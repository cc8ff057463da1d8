#include "graph/analysis/all_paths.h"

#include <cstdint>
#include <set>
#include <tuple>
#include <utility>

namespace jarol::analysis {
namespace {

// Depth first, on a stack of its own: a path may be as long as there are tasks.
class PathSearch {
 public:
  explicit PathSearch(const Graph& graph)
      : graph_(graph),
        after_task_(graph.tasks.size()),
        after_communicator_(graph.communicators.size()),
        before_out_(graph.tasks.size(), false),
        on_path_(graph.tasks.size(), false) {
    std::set<std::tuple<End::Kind, std::size_t, End::Kind, std::size_t>> known;
    // what leaves at once comes first: beyond it there may be more ways than are walked
    for (const End::Kind kind : {End::Kind::communicator, End::Kind::task})
      for (const Connection& c : graph.connections)
        if (c.to.kind == kind && known.emplace(c.from.kind, c.from.index, kind, c.to.index).second)
          after(c.from).push_back(c.to);
    mark_before_outs();
  }

  AllPaths run() {
    for (std::size_t i = 0; i < graph_.communicators.size() && !found_.more && found_.whole; ++i)
      if (graph_.communicators[i].direction == Direction::in) search_from({End::Kind::communicator, i, 0});
    return std::move(found_);
  }

 private:
  std::vector<End>& after(const End& end) {
    return (end.kind == End::Kind::task ? after_task_ : after_communicator_)[end.index];
  }

  // Of tasks from which no path leads to an `out` there may be more ways than anyone can walk.
  void mark_before_outs() {
    std::vector<std::vector<std::size_t>> producers(graph_.tasks.size());
    std::vector<std::size_t> open;
    for (const Connection& c : graph_.connections) {
      if (c.from.kind != End::Kind::task) continue;
      (c.to.kind == End::Kind::task ? producers[c.to.index] : open).push_back(c.from.index);
    }
    while (!open.empty()) {
      const std::size_t task = open.back();
      open.pop_back();
      if (before_out_[task]) continue;
      before_out_[task] = true;
      open.insert(open.end(), producers[task].begin(), producers[task].end());
    }
  }

  void search_from(const End& in) {
    std::vector<End> path{in};
    std::vector<std::size_t> tried{0};  // per hop, how many ways on
    while (!path.empty()) {
      const End at = path.back();
      if (tried.back() == after(at).size()) {
        if (at.kind == End::Kind::task) on_path_[at.index] = false;
        path.pop_back();
        tried.pop_back();
        continue;
      }
      found_.whole = ++steps_ <= max_steps;
      if (!found_.whole) return;
      const End to = after(at)[tried.back()++];
      if (to.kind == End::Kind::communicator) {
        if (!add(path, to)) return;
      } else if (before_out_[to.index] && !on_path_[to.index]) {
        on_path_[to.index] = true;
        path.push_back(to);
        tried.push_back(0);
      }
    }
  }

  // False if there are too many.
  bool add(std::vector<End> path, const End& out) {
    found_.more = found_.paths.size() == max_paths;
    if (found_.more) return false;
    path.push_back(out);
    found_.paths.push_back(std::move(path));
    return true;
  }

  static constexpr std::uint64_t max_steps = 10'000'000;

  const Graph& graph_;
  std::uint64_t steps_ = 0;
  std::vector<std::vector<End>> after_task_, after_communicator_;  // each end once
  std::vector<bool> before_out_, on_path_;                         // per task
  AllPaths found_;
};

}  // namespace

AllPaths all_paths(const Graph& graph) { return PathSearch(graph).run(); }

}  // namespace jarol::analysis

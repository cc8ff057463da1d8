#include "distributers/campaign/run_all.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <exception>
#include <mutex>

namespace jarol::campaign {
namespace {

// What the threads share: all but the graphs, under one lock that is held for moments.
class Queue {
 public:
  Queue(const std::vector<std::uint64_t>& indices, const Draws& draws, Results& results,
        const std::function<void(const Result&)>& seen)
      : indices_(indices), draws_(draws), results_(results), seen_(seen) {}

  std::optional<Start> next() {
    const std::lock_guard lock(mutex_);
    if (next_ == indices_.size() || failure_) return std::nullopt;
    return draws_.at(indices_[next_++]);
  }

  void add(const Start& start, const Result& result) {
    const std::lock_guard lock(mutex_);
    if (failure_) return;
    try {
      results_.add(start, result);
      seen_(result);
    } catch (...) { failure_ = std::current_exception(); }
  }

  void throw_if_failed() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  const std::vector<std::uint64_t>& indices_;
  const Draws& draws_;
  Results& results_;
  const std::function<void(const Result&)>& seen_;
  std::mutex mutex_;
  std::size_t next_ = 0;
  std::exception_ptr failure_;
};

}  // namespace

std::vector<std::uint64_t> missing(const std::vector<std::uint64_t>& done, const Shard& shard, std::uint64_t runs) {
  std::vector<std::uint64_t> indices;
  auto found = std::lower_bound(done.begin(), done.end(), shard.begin(runs));
  for (std::uint64_t i = shard.begin(runs); i < shard.end(runs); ++i) {
    if (found != done.end() && *found == i)
      ++found;
    else
      indices.push_back(i);
  }
  return indices;
}

void run_all(Graphs& graphs, const Campaign& campaign, const Draws& draws, const std::vector<std::uint64_t>& indices,
             std::size_t workers, Results& results, const std::function<void(const Result&)>& seen,
             const std::atomic<bool>& stop) {
  Queue queue(indices, draws, results, seen);
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, workers);
  tbb::task_arena arena(static_cast<int>(workers));
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, workers, [&](std::size_t) {
      while (!stop.load(std::memory_order_relaxed)) {
        const std::optional<Start> start = queue.next();
        if (!start) return;
        if (const std::optional<Result> result = run_one(graphs, *start, campaign.length, stop))
          queue.add(*start, *result);
      }
    });
  });
  queue.throw_if_failed();
}

}  // namespace jarol::campaign

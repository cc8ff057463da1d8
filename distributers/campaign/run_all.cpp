#include "distributers/campaign/run_all.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "runtime/machine/signal_stack.h"

namespace jarol::campaign {
std::optional<std::uint64_t> OwnWork::next() {
  const std::lock_guard lock(mutex_);
  if (next_ == indices_.size() || failure_ || stop_.load(std::memory_order_relaxed)) return std::nullopt;
  return indices_[next_++];
}

void OwnWork::add(const Result& result) {
  const std::lock_guard lock(mutex_);
  if (failure_) return;
  try {
    results_.add(draws_.at(result.index), result);
    seen_(result);
  } catch (...) { failure_ = std::current_exception(); }
}

void OwnWork::throw_if_failed() const {
  if (failure_) std::rethrow_exception(failure_);
}

std::vector<std::uint64_t> missing(const std::vector<std::uint64_t>& done, const RunRange& range) {
  std::vector<std::uint64_t> indices;
  auto found = std::lower_bound(done.begin(), done.end(), range.begin);
  for (std::uint64_t i = range.begin; i < range.end; ++i) {
    if (found != done.end() && *found == i)
      ++found;
    else
      indices.push_back(i);
  }
  return indices;
}

void run_work(Graphs& graphs, const Campaign& campaign, const Draws& draws, Work& work, std::size_t workers,
              const Oversight& oversight) {
  std::mutex mutex;
  std::exception_ptr failure;
  std::atomic<bool> failed{false};
  const auto fail = [&] {
    const std::lock_guard lock(mutex);
    if (!failure) failure = std::current_exception();
    failed = true;
  };
  const auto do_work = [&] {
    try {
      const SignalStack stack;  // a task may use up that of the thread
      while (!failed.load(std::memory_order_relaxed) && !oversight.stop.load(std::memory_order_relaxed)) {
        const std::optional<std::uint64_t> index = work.next();
        if (!index) return;
        if (const std::optional<Result> result = run_one(graphs, draws.at(*index), campaign.length, oversight))
          work.add(*result);
      }
    } catch (...) { fail(); }
  };
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, workers);
  tbb::task_arena arena(static_cast<int>(workers));
  arena.execute([&] { tbb::parallel_for(std::size_t{0}, workers, [&](std::size_t) { do_work(); }); });
  if (failure) std::rethrow_exception(failure);
}

void run_all(Graphs& graphs, const Campaign& campaign, const Draws& draws, const std::vector<std::uint64_t>& indices,
             std::size_t workers, Results& results, const std::function<void(const Result&)>& seen,
             const Oversight& oversight) {
  OwnWork work(indices, draws, results, seen, oversight.stop);
  run_work(graphs, campaign, draws, work, workers, oversight);
  work.throw_if_failed();
}

}  // namespace jarol::campaign

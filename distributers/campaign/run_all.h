// The runs of a campaign that are not in its results yet, spread over threads.
#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include "distributers/campaign/results.h"
#include "distributers/campaign/run_one.h"

namespace jarol::campaign {

/// Which of the runs: the part `index` of `count` parts, from 0, each of consecutive runs.
struct Shard {
  std::uint64_t index = 0;
  std::uint64_t count = 1;

  /// Of a campaign of so many runs.
  RunRange of(std::uint64_t runs) const { return {part(index, runs), part(index + 1, runs)}; }

 private:
  std::uint64_t part(std::uint64_t i, std::uint64_t runs) const {
    return static_cast<std::uint64_t>(static_cast<__uint128_t>(runs) * i / count);
  }
};

/// The indices of a range that are not among those that are done, which go up.
std::vector<std::uint64_t> missing(const std::vector<std::uint64_t>& done, const RunRange& range);

/// Runs that are to be done, as those see them who do them, on any thread.
class Work {
 public:
  virtual ~Work() = default;
  /// The index of one that nobody else does; none: there are no more.
  virtual std::optional<std::uint64_t> next() = 0;
  virtual void add(const Result& result) = 0;
};

/// Those of some indices, in that order, whose results go where they belong under one lock that is held for moments.
class OwnWork : public Work {
 public:
  /// All that is named outlives it. `seen` is called with each result, one at a time.
  OwnWork(const std::vector<std::uint64_t>& indices, const Draws& draws, Results& results,
          const std::function<void(const Result&)>& seen, const std::atomic<bool>& stop)
      : indices_(indices), draws_(draws), results_(results), seen_(seen), stop_(stop) {}

  std::optional<std::uint64_t> next() override;
  void add(const Result& result) override;
  /// Once nobody works any more: what the results have thrown.
  void throw_if_failed() const;

 private:
  const std::vector<std::uint64_t>& indices_;
  const Draws& draws_;
  Results& results_;
  const std::function<void(const Result&)>& seen_;
  const std::atomic<bool>& stop_;
  std::mutex mutex_;
  std::size_t next_ = 0;
  std::exception_ptr failure_;
};

/// Does all of it on so many threads, the caller's among them; returns when there is no more, or soon after a stop.
/// Throws the first that a run has thrown; no run is begun after that.
void run_work(Graphs& graphs, const Campaign& campaign, const Draws& draws, Work& work, std::size_t workers,
              const Oversight& oversight);

/// Runs them on so many threads, the caller's among them, and adds each result as it comes. `seen` is called then, one
/// at a time. Returns when all are done, or soon after a stop; throws what `results` throws.
void run_all(Graphs& graphs, const Campaign& campaign, const Draws& draws, const std::vector<std::uint64_t>& indices,
             std::size_t workers, Results& results, const std::function<void(const Result&)>& seen,
             const Oversight& oversight);

}  // namespace jarol::campaign

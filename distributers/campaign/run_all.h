// The runs of a campaign that are not in its results yet, spread over threads.
#pragma once

#include <atomic>
#include <functional>

#include "distributers/campaign/results.h"
#include "distributers/campaign/run_one.h"

namespace jarol::campaign {

/// Which of the runs: the part `index` of `count` parts, from 0, each of consecutive runs.
struct Shard {
  std::uint64_t index = 0;
  std::uint64_t count = 1;

  std::uint64_t begin(std::uint64_t runs) const { return part(index, runs); }
  std::uint64_t end(std::uint64_t runs) const { return part(index + 1, runs); }

 private:
  std::uint64_t part(std::uint64_t i, std::uint64_t runs) const {
    return static_cast<std::uint64_t>(static_cast<__uint128_t>(runs) * i / count);
  }
};

/// The indices of a shard that are not among those that are done, which go up.
std::vector<std::uint64_t> missing(const std::vector<std::uint64_t>& done, const Shard& shard, std::uint64_t runs);

/// Runs them on so many threads, the caller's among them, and adds each result as it comes. `seen` is called then, one
/// at a time. Returns when all are done, or soon after `stop`; throws what `results` throws.
void run_all(Graphs& graphs, const Campaign& campaign, const Draws& draws, const std::vector<std::uint64_t>& indices,
             std::size_t workers, Results& results, const std::function<void(const Result&)>& seen,
             const std::atomic<bool>& stop);

}  // namespace jarol::campaign

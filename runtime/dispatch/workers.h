// Threads that share work in parts. Whoever is free first takes a part, the caller included: a thread that is asleep or
// was not given a processor holds nobody up, so that more workers than processors cost little.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <thread>
#include <vector>

#include "runtime/machine/running_task.h"

namespace jarol {

class Workers {
 public:
  using Job = void (*)(void* context, std::size_t part);

  /// `count` workers, of which the caller of `run` is one, at least 1; they share `parts` parts. Throws
  /// std::system_error where no thread can be started.
  Workers(std::size_t count, std::size_t parts);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  std::size_t count() const { return threads_.size() + 1; }
  std::size_t parts() const { return claims_.size(); }

  /// What the threads beside the caller's run, for whoever asks; a null while one begins.
  std::span<const std::atomic<const RunningTask*>> others() const { return others_; }

  /// Calls job(context, part) once for each part 0 .. parts() - 1, on whatever workers, and returns when all are done.
  /// What the parts wrote is visible to the caller then. The job does not throw.
  void run(Job job, void* context);

 private:
  struct alignas(64) Claim {
    std::atomic<std::uint64_t> round{0};  // the newest one in which somebody took the part
  };

  void end();
  void work(std::size_t first, std::atomic<const RunningTask*>& running);
  void take_parts(std::size_t first, std::uint64_t round);

  std::vector<Claim> claims_;
  Job job_ = nullptr;
  void* context_ = nullptr;
  alignas(64) std::atomic<std::uint64_t> round_{0};  // raised when job and context are set; the top bit ends
  alignas(64) std::atomic<std::uint64_t> done_{0};   // parts done in all rounds
  std::vector<std::atomic<const RunningTask*>> others_;
  std::vector<std::thread> threads_;
};

}  // namespace jarol

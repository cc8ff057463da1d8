// What a run reports of itself, whoever runs its tasks.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/run/fault_text.h"

namespace jarol {

struct Report {
  static constexpr std::size_t faults_kept = 1000;

  std::uint64_t digest = 0;
  Duration simulated{};
  Duration covered{};             // the instants before it were run
  std::uint64_t activations = 0;  // released tasks that ran
  std::uint64_t instants = 0;     // distinct instants at which anything was due
  std::vector<Fault> faults;      // the first of them; all are counted
  std::uint64_t fault_count = 0;
  std::uint64_t non_finite_inputs = 0;  // from outside, not taken
  bool stopped = false;                 // by a fault
  FaultSummary fault_summary;           // of all faults
  std::vector<std::uint64_t> left_out;  // per task: activations without outputs

  explicit Report(std::size_t tasks = 0) : left_out(tasks) { faults.reserve(faults_kept); }
  void add(const FaultWords& fault) {
    fault_summary.add(fault);
    if (faults.size() < faults_kept) faults.push_back(fault.kept());
    ++fault_count;
  }

  void serialize(Archive& archive) {
    archive(digest, simulated, covered, activations, instants, faults, fault_count, non_finite_inputs, stopped,
            fault_summary);
    archive.same(left_out.size(), "is of other tasks");
    for (std::uint64_t& each : left_out) archive(each);
  }
};

}  // namespace jarol

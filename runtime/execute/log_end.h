// What a log says of how its run ended.
#pragma once

#include "runtime/execute/executor.h"
#include "runtime/record/recording_format.h"

namespace jarol {

inline LogEnd log_end_of(const Report& report) {
  return {report.covered.count(), report.simulated.count(), report.digest,
          report.activations,     report.instants,          report.fault_count};
}

}  // namespace jarol

// The test of a whole system, by how its tasks are spread over cores. `whole`: with witness and responses.
#pragma once

#include "graph/analysis/check.h"

namespace jarol::analysis {

/// A time table on each core.
Result check_on_table(const System& system, bool whole, Budget& budget);

/// Core by core, each with the policy's own test (one_core.h).
Result check_partitioned(const System& system, bool whole, Budget& budget);

/// Tasks on no core of their own.
Result check_globally(const System& system, bool whole, Budget& budget);

}  // namespace jarol::analysis

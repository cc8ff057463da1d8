// Tasks that reach writable globals by an index; of libraries for far addresses (-mcmodel=large), too.
#include "tests/isolation/task.h"

namespace {

double counts[8], sums[8];
double* pick(std::int64_t i) { return i != 0 ? &counts[0] : &sums[0]; }

// offends: a writable global: counts: ByIndex::run
TASK(ByIndex, { out.out = counts[state.address & 7]++; })
// offends: a writable global: counts: ByPlace::run
TASK(ByPlace, {
  counts[2] += in.in;
  out.out = counts[2];
})
// offends: a writable global: sums: ByChoice::run...
TASK(ByChoice, { *pick(tick.activation & 1) = in.in; })

}  // namespace

JAROL_PLUGIN(ByIndex, ByPlace, ByChoice)

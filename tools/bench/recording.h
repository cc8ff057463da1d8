// What recording every published value to a file costs.
#pragma once

#include "tools/bench/figures.h"

namespace jarol::bench {

/// Four million values of 64 bytes, computed, recorded and written: the floor is a nanosecond, the ratio thus the
/// nanoseconds of a value. The file is in the folder for temporary files, and goes again.
Figure measure_recording(const std::string& name, bool digest, double goal, int repeats);

}  // namespace jarol::bench

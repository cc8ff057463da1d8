// Times as pages get them.
#pragma once

#include <chrono>

namespace jarol::tools::console {

inline double seconds(std::chrono::nanoseconds time) { return std::chrono::duration<double>(time).count(); }

}  // namespace jarol::tools::console

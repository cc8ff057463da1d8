// This process has been asked to end: who waits for another program then, waits only a little longer.
#pragma once

#include <chrono>

namespace jarol {

/// How long is still waited for what may be under way. Shorter than a run that ends waits for its threads.
inline constexpr std::chrono::milliseconds patience_at_end{500};

/// From now on; may be called by a signal handler. A second time changes nothing.
void ask_to_end();
/// Until it is asked anew, as for the next run of the process.
void forget_asked_to_end();

/// Whoever has waited since then need not wait any longer.
bool has_waited_enough(std::chrono::steady_clock::time_point since);

/// How often whoever waits has to look at that.
inline constexpr std::chrono::milliseconds look_at_end{50};

}  // namespace jarol

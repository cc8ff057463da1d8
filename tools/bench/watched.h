// How late a run on the real clock is while people watch it on pages.
#pragma once

#include <string>

#include "tools/bench/figures.h"

namespace jarol::bench {

/// 99 of 100 latenesses at 1 kHz of a chain of tasks with a console, whose pages are `watchers` sockets in another
/// process, to that without one. `reads`: they read what they are sent.
Figure measure_watched(const std::string& name, int watchers, bool reads, int repeats);

/// The layout of a graph of 200 tasks, whose floor is a second.
Figure measure_layout(const std::string& name, int repeats);

}  // namespace jarol::bench

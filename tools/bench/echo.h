// What it takes from a datagram to the answer of a task, beside a bare echo.
#pragma once

#include <string>

#include "tools/bench/figures.h"

namespace jarol::bench {

/// Round trip of one datagram over the loopback: link, port, task, port, link; and with the same three threads and the
/// same bytes, but nothing else. The thread in the middle looks all the time, the one that sends is woken.
Figure measure_udp_echo(const std::string& name, int repeats);

}  // namespace jarol::bench

// The guardian's side: the process that waits for the end of another.
#pragma once

namespace jarol::distributers {

/// Where its end of the pair of sockets is.
inline constexpr int guardian_socket = 3;

/// The priority of SCHED_FIFO that it takes, if it may; 0: none.
struct Urgency {
  int priority = 0;
};

/// Is a process that was called as this to be a guardian?
bool is_guardian(const char* name);

/// All that it does, to its end; the exit code.
int run_guardian();

}  // namespace jarol::distributers

// Whether code calls the system, found by the kernel itself (syscall user dispatch, Linux 5.11).
#pragma once

#include <functional>
#include <optional>

namespace jarol::tests {

/// What the calling thread asks the kernel for first while `code` runs: its number, -1: for nothing. None: this kernel
/// can't say.
std::optional<long> first_system_call_of(const std::function<void()>& code);

}  // namespace jarol::tests

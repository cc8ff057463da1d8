#include "tests/caught_system_calls.h"

#include <linux/prctl.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <ucontext.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

namespace {
volatile char selector = SYSCALL_DISPATCH_FILTER_ALLOW;
volatile long first = -1;

// The call is made all the same, and no other one is caught.
void caught(int, siginfo_t* info, void* context) {
  selector = SYSCALL_DISPATCH_FILTER_ALLOW;
  first = info->si_syscall;
#if defined(__x86_64__)
  auto& registers = static_cast<ucontext_t*>(context)->uc_mcontext.gregs;
  const long result = syscall(first, registers[REG_RDI], registers[REG_RSI], registers[REG_RDX], registers[REG_R10],
                              registers[REG_R8], registers[REG_R9]);
  registers[REG_RAX] = result < 0 ? -errno : result;
#else
  (void)context;
#endif
}
}  // namespace

std::optional<long> jarol::tests::first_system_call_of(const std::function<void()>& code) {
#if defined(__x86_64__)
  struct sigaction action {
  }, before{};
  action.sa_sigaction = caught;
  action.sa_flags = SA_SIGINFO;
  sigaction(SIGSYS, &action, &before);
  first = -1;
  const auto off = [&] {
    selector = SYSCALL_DISPATCH_FILTER_ALLOW;
    prctl(PR_SET_SYSCALL_USER_DISPATCH, PR_SYS_DISPATCH_OFF, 0, 0, 0);
    sigaction(SIGSYS, &before, nullptr);
  };
  if (prctl(PR_SET_SYSCALL_USER_DISPATCH, PR_SYS_DISPATCH_ON, 0, 0, &selector) != 0) {
    off();
    return std::nullopt;
  }
  selector = SYSCALL_DISPATCH_FILTER_BLOCK;
  code();
  off();
  return first;
#else
  (void)code;
  return std::nullopt;
#endif
}

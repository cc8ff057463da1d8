#include "tools/commands/run/crash_line.h"

#include <signal.h>
#include <sys/syscall.h>
#include <ucontext.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <optional>
#include <string>
#include <string_view>

#include "distributers/campaign/running_run.h"
#include "distributers/guardian/guardian.h"
#include "graph/text/escape.h"
#include "graph/text/shell_word.h"
#include "runtime/dispatch/task_guard.h"
#include "runtime/files/temporary_files.h"
#include "runtime/machine/running_task.h"
#include "runtime/state/task_status.h"
#include "tools/commands/run/prompt_line.h"
#include "tools/report/exit_code.h"

namespace jarol::tools {
namespace {

struct CrashSignal {
  int signal;
  std::string_view name;
  bool tells_address;
};
constexpr std::array kinds{CrashSignal{SIGSEGV, "segmentation fault", true},
                           CrashSignal{SIGBUS, "bus error", true},
                           CrashSignal{SIGILL, "illegal instruction", false},
                           CrashSignal{SIGFPE, "arithmetic exception", false},
                           CrashSignal{SIGABRT, "abort", false},
                           CrashSignal{SIGTRAP, "trap", false},
                           CrashSignal{SIGSYS, "forbidden system call", false}};

std::atomic<const Graph*> running_graph{nullptr};
std::atomic<const distributers::Guardian*> guardian{nullptr};
std::atomic<bool> crashed{false};
std::string about_log;  // a line, or nothing
pid_t own_process = 0;  // not that of a child which a task has made
std::array<struct sigaction, kinds.size()> handlers_before;

// All that follows may run in a signal handler: it allocates nothing and locks nothing.
class Line {
 public:
  Line& operator<<(std::string_view text) {
    const std::size_t size = std::min(text.size(), text_.size() - size_);
    std::memcpy(text_.data() + size_, text.data(), size);
    size_ += size;
    return *this;
  }
  Line& operator<<(std::int64_t number) {
    if (number < 0) *this << "-";
    const auto bits = static_cast<std::uint64_t>(number);
    return number_in(number < 0 ? 0 - bits : bits, 10);
  }
  Line& hexadecimal(std::uint64_t number) { return (*this << "0x").number_in(number, 16); }
  // as seconds_text writes it
  Line& seconds(Duration time) {
    constexpr std::int64_t second = 1'000'000'000;
    *this << time.count() / second;
    std::array<char, 10> digits{'.'};
    std::size_t length = digits.size();
    for (std::int64_t i = 9, rest = time.count() % second; i > 0; --i, rest /= 10)
      digits[static_cast<std::size_t>(i)] = static_cast<char>('0' + rest % 10);
    while (length > 0 && (digits[length - 1] == '0' || digits[length - 1] == '.')) --length;
    return *this << std::string_view(digits.data(), length);
  }
  void write() {
    *this << "; the process ends\n";
    text_[size_ - 1] = '\n';  // where there was no room for all of it
    write_promptly({text_.data(), size_});
  }

 private:
  Line& number_in(std::uint64_t number, std::uint64_t base) {
    std::array<char, 20> digits;
    std::size_t first = digits.size();
    do digits[--first] = "0123456789abcdef"[number % base];
    while ((number /= base) != 0);
    return *this << std::string_view(digits.data() + first, digits.size() - first);
  }

  std::array<char, 1024> text_;
  std::size_t size_ = 0;
};

void name_task(Line& line) {
  line << "crash: ";
  if (const std::int64_t run = campaign::running_run.load(std::memory_order_relaxed); run != campaign::no_run)
    line << "run " << run << " of the campaign: ";
  const TaskMemory* const memory = running_task.memory.load(std::memory_order_relaxed);
  const Graph* const of = running_graph.load();
  if (memory == nullptr || of == nullptr) {
    line << "no task ran in this thread: ";
    return;
  }
  const Tick& tick = *running_task.tick.load(std::memory_order_relaxed);
  line << "task '" << of->tasks[static_cast<const TaskStatus*>(memory->fault)->task].name << "' activation "
       << tick.activation << " at ";
  line.seconds(tick.now) << " s: ";
}

// A thread that crashes while another one says so waits for the end.
void wait_if_second() {
  while (crashed.exchange(true)) ::pause();
}

// First the guardian acts, while the line is written and a core is dumped.
void leave(Line& line) {
  if (const auto* const awake = guardian.load()) awake->wake();
  remove_temporary_files();
  line.write();
  write_promptly(about_log);
}

// The stack pointer stands beyond the stack, or will with the next call.
bool is_stack_used_up(void* context) {
  constexpr std::uintptr_t close_to_end = 16 << 10;
  std::uintptr_t at = 0;
#if defined(__x86_64__)
  at = static_cast<std::uintptr_t>(static_cast<ucontext_t*>(context)->uc_mcontext.gregs[REG_RSP]);
#elif defined(__aarch64__)
  at = static_cast<std::uintptr_t>(static_cast<ucontext_t*>(context)->uc_mcontext.sp);
#else
  static_cast<void>(context);
#endif
  return at != 0 && running_task.stack_end != 0 && at < running_task.stack_end + close_to_end;
}

// What a task wrote to under guard.
void name_forbidden(Line& line, const void* address) {
  const Graph* const of = running_graph.load();
  if (const auto owner = TaskGuard::find_owner(address); owner && of != nullptr) {
    line << "wrote to the " << (owner->has_parameters_there ? "parameters" : "memory") << " of task '"
         << of->tasks[owner->task].name << "'";
    return;
  }
  line << "wrote to memory that is not its own";
  if (const std::string_view name = PageGuard::name_of(address); !name.empty()) line << ", of '" << name << "',";
}

// Is there an address in the way of which page protection stood?
PageGuard::Fault judge(int signal, const siginfo_t& info) {
  if (signal == SIGSEGV && info.si_code == SEGV_ACCERR) return PageGuard::judge(info.si_addr);
  PageGuard::lift();
  return PageGuard::Fault::other;
}

extern "C" void on_crash(int signal, siginfo_t* info, void* context) {
  const int error = errno;
  const PageGuard::Fault fault = judge(signal, *info);
  if (fault == PageGuard::Fault::waited) {
    errno = error;
    return;
  }
  wait_if_second();
  const CrashSignal& kind =
      *std::find_if(kinds.begin(), kinds.end(), [&](const CrashSignal& k) { return k.signal == signal; });
  Line line;
  if (info->si_code == SI_USER && info->si_pid != ::getpid()) {
    line << "crash: " << kind.name << ", sent by process " << info->si_pid;
  } else {
    name_task(line);
    if (fault == PageGuard::Fault::forbidden)
      name_forbidden(line, info->si_addr);
    else if (signal == SIGSEGV && is_stack_used_up(context))
      line << "stack overflow";
    else
      line << kind.name;
    if (kind.tells_address && info->si_code > 0) {
      line << " at address ";
      line.hexadecimal(reinterpret_cast<std::uintptr_t>(info->si_addr));
    }
  }
  leave(line);
  // it comes again as soon as this returns, and then ends the process
  ::signal(signal, SIG_DFL);
  ::raise(signal);
}

[[noreturn]] void end_process(int code) {
  for (;;) ::syscall(SYS_exit_group, code);
}

// In the thread that called it, before anything else is torn down.
void on_exit_called(std::string_view call, std::optional<int> code = {}) {
  PageGuard::lift();
  if (running_graph.load() == nullptr || ::getpid() != own_process) return;
  wait_if_second();
  Line line;
  name_task(line);
  line << "called " << call;
  if (code) line << "(" << *code << ")";
  leave(line);
  end_process(exit_unfinished);
}

// A thread that ends the process while another one reports its crash waits for that end.
void wait_for_crash() {
  while (crashed.load() && ::getpid() == own_process) ::pause();
}

// Once: handlers of exit can't be taken away.
void watch_exit() {
  [[maybe_unused]] static const int watched = ::on_exit([](int code, void*) { on_exit_called("exit", code); }, nullptr);
  [[maybe_unused]] static const int quick = ::at_quick_exit([] { on_exit_called("quick_exit"); });
}

}  // namespace

CrashLine::CrashLine(const Graph& of, const distributers::Guardian* awake, const std::string& log) {
  about_log.clear();
  if (!log.empty())
    about_log = "note: the recording '" + printable(log) + "' is good up to its last chunk: jarol replay " +
                printable(shell_word(log)) + "\n";
  own_process = ::getpid();
  running_graph.store(&of);
  guardian.store(awake);
  watch_exit();
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    struct sigaction action {};
    action.sa_sigaction = on_crash;
    action.sa_flags = SA_SIGINFO | SA_ONSTACK;
    sigfillset(&action.sa_mask);
    ::sigaction(kinds[i].signal, &action, &handlers_before[i]);
  }
}

CrashLine::~CrashLine() {
  for (std::size_t i = 0; i < kinds.size(); ++i) ::sigaction(kinds[i].signal, &handlers_before[i], nullptr);
  guardian.store(nullptr);
  running_graph.store(nullptr);
}

void end_at_once(int exit_code) {
  std::cout.flush();
  std::cerr.flush();
  remove_temporary_files();
  wait_for_crash();
  end_process(exit_code);
}

}  // namespace jarol::tools

// In the place of the C library's, for what is called while a run goes on: nothing of the program would learn of it.
// Libraries that a program loads find its own first.
extern "C" {
void _exit(int code) {
  jarol::tools::on_exit_called("_exit", code);
  jarol::tools::wait_for_crash();
  jarol::tools::end_process(code);
}
void _Exit(int code) noexcept { _exit(code); }
}

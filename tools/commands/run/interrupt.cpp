#include "tools/commands/run/interrupt.h"

#include <signal.h>
#include <unistd.h>

#include <csignal>
#include <ctime>
#include <iostream>
#include <utility>

#include "runtime/files/temporary_files.h"
#include "runtime/machine/asked_to_end.h"
#include "tools/commands/run/prompt_line.h"

namespace jarol::tools {
namespace {

std::atomic<bool> flag{false};
std::atomic<int> last_signal{0};
std::atomic<bool> alive{false};
std::atomic<bool> may_hasten{false}, hastened{false};
std::atomic<std::int64_t> counted_at{0};  // ns, of the newest that counts; 0: none has come
std::atomic<bool> only_report_left{false};
std::function<void()> call;

constexpr unsigned report_patience = 1;            // s
constexpr std::int64_t second_from = 500'000'000;  // ns: what comes sooner is the same wish, reported twice

// Nobody reads the report.
extern "C" void end_without_report(int) {
  const int signal = last_signal.load();
  std::signal(signal, SIG_DFL);
  remove_temporary_files();
  write_promptly("nobody reads what is printed: ended without the rest of the report\n");
  // not this thread alone, which may leave signals to others
  ::kill(::getpid(), signal);
}

void end_soon() {
  std::signal(SIGALRM, end_without_report);
  ::alarm(report_patience);
}

std::int64_t now() {
  timespec time{};
  ::clock_gettime(CLOCK_MONOTONIC, &time);
  return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

extern "C" void interrupt(int signal) {
  // another thread may take the second signal before this one has done more
  std::int64_t before = 0;
  if (counted_at.compare_exchange_strong(before, now())) {
    ask_to_end();
    last_signal.store(signal);
    flag.store(true);
    if (alive.load()) call();
    if (only_report_left.load()) end_soon();
    return;
  }
  if (now() - before < second_from) return;
  if (may_hasten.exchange(false)) {
    counted_at.store(now());
    hastened.store(true);
    return;
  }
  // whoever asks again does not want to wait for the end, nor, the third time, for this line
  std::signal(signal, SIG_DFL);
  remove_temporary_files();
  write_promptly("interrupted again: ended at once, without a report\n");
  std::raise(signal);
}

}  // namespace

Interruptible::Interruptible(std::function<void()> at_once, HaltKey halt_key, SecondSignal second_signal)
    : count_(signals.size() - (halt_key == HaltKey::halts ? 1 : 0)) {
  call = std::move(at_once);
  flag.store(false);
  last_signal.store(0);
  may_hasten.store(second_signal == SecondSignal::hastens);
  hastened.store(false);
  counted_at.store(0);
  only_report_left.store(false);
  forget_asked_to_end();
  alive.store(true);
  for (std::size_t i = 0; i < count_; ++i) {
    before_[i] = std::signal(signals[i], interrupt);
    // what was started under nohup goes on when its terminal is gone, and a shell may keep Ctrl-Z for itself
    if ((signals[i] == SIGHUP || signals[i] == SIGTSTP) && before_[i] == SIG_IGN) std::signal(signals[i], SIG_IGN);
  }
}

Interruptible::~Interruptible() {
  alive.store(false);
  // after an interruption a second signal still must not cut off the report
  if (flag.load()) return;
  for (std::size_t i = 0; i < count_; ++i) std::signal(signals[i], before_[i]);
}

const std::atomic<bool>& Interruptible::interrupted() { return flag; }

int Interruptible::signal() { return last_signal.load(); }

Wish Interruptible::wish() { return {last_signal.load(), hastened.load()}; }

void Interruptible::forbid_haste() { may_hasten.store(false); }

void Interruptible::report(const std::function<void()>& print) {
  only_report_left.store(true);
  if (flag.load()) end_soon();
  print();
  std::cout.flush();
  only_report_left.store(false);
  ::alarm(0);
}

void let_writing_fail() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace jarol::tools

#include "tools/interrupt.h"

#include <csignal>

namespace jarol::tools {
namespace {

std::atomic<bool> flag{false};
std::function<void()> call;

extern "C" void interrupt(int) {
  flag.store(true, std::memory_order_relaxed);
  call();
}

}  // namespace

Interruptible::Interruptible(std::function<void()> at_once) {
  flag.store(false);
  call = std::move(at_once);
  before_int_ = std::signal(SIGINT, interrupt);
  before_term_ = std::signal(SIGTERM, interrupt);
}

Interruptible::~Interruptible() {
  std::signal(SIGINT, before_int_);
  std::signal(SIGTERM, before_term_);
}

const std::atomic<bool>& Interruptible::interrupted() { return flag; }

}  // namespace jarol::tools

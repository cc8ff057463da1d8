// A stack for signal handlers, so that one can run in a thread whose own stack is used up.
#pragma once

#include <cstddef>

namespace jarol {

/// Of the calling thread, while this lives; where it has one already, nothing. Every thread that runs tasks has one.
class SignalStack {
 public:
  SignalStack();
  ~SignalStack();
  SignalStack(const SignalStack&) = delete;
  SignalStack& operator=(const SignalStack&) = delete;

 private:
  static constexpr std::size_t size = std::size_t{64} << 10;
  void* memory_ = nullptr;
};

}  // namespace jarol

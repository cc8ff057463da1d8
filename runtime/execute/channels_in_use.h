// The channels while an instant covers them: nobody else may use them then, and nothing covers them once the run is
// closed.
#pragma once

#include "runtime/execute/executor.h"

namespace jarol {

class Executor::ChannelsInUse {
 public:
  /// Null: the instant needs none.
  explicit ChannelsInUse(std::atomic<Use>* use) : use_(use) {
    if (use_ == nullptr) return;
    Use free = Use::free;
    closed_ = !use_->compare_exchange_strong(free, Use::covering, std::memory_order_acquire);
    if (closed_) use_ = nullptr;
  }
  ~ChannelsInUse() { end(); }
  ChannelsInUse(const ChannelsInUse&) = delete;
  ChannelsInUse& operator=(const ChannelsInUse&) = delete;

  bool closed() const { return closed_; }
  void end() {
    if (use_ != nullptr) use_->store(Use::free, std::memory_order_release);
    use_ = nullptr;
  }

 private:
  std::atomic<Use>* use_;
  bool closed_ = false;
};

}  // namespace jarol

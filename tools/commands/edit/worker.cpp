#include "tools/commands/edit/worker.h"

#include <algorithm>

namespace jarol::tools::edit {

Worker::Worker() : thread_([this] { run(); }) {}

Worker::~Worker() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  asked_.notify_one();
  thread_.join();
}

void Worker::ask(std::uint64_t page, Work work) {
  {
    const std::lock_guard lock(mutex_);
    const auto same = [&](const auto& other) { return other.first == page; };
    if (const auto found = std::find_if(waiting_.begin(), waiting_.end(), same); found != waiting_.end()) {
      found->second = std::move(work);
    } else {
      waiting_.emplace_back(page, std::move(work));
    }
  }
  asked_.notify_one();
}

void Worker::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    asked_.wait(lock, [this] { return ending_ || !waiting_.empty(); });
    if (ending_) return;
    const Work work = std::move(waiting_.front().second);
    waiting_.pop_front();
    lock.unlock();
    work();
    lock.lock();
  }
}

}  // namespace jarol::tools::edit

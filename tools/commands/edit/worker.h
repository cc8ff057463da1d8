// What takes its time, on a thread of its own: of each page the newest request alone.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace jarol::tools::edit {

class Worker {
 public:
  using Work = std::function<void()>;

  Worker();
  /// What goes on is waited for, what waits is dropped.
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// In the place of what that page has asked for and is not begun; pages in turn.
  void ask(std::uint64_t page, Work work);

 private:
  void run();

  std::mutex mutex_;
  std::condition_variable asked_;
  std::deque<std::pair<std::uint64_t, Work>> waiting_;
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace jarol::tools::edit

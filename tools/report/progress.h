// A progress line on a terminal for work that takes a while; it is gone when the work is done.
#pragma once

#include <condition_variable>
#include <cstdio>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "graph/language/quantities.h"

namespace jarol::tools {

class Progress {
 public:
  /// Shows `now()` against `end` five times a second, unless `shown` is false.
  Progress(bool shown, Duration end, std::function<Duration()> now)
      : Progress(shown, [end, now = std::move(now)] {
          const double part = static_cast<double>(now().count()) / static_cast<double>(end.count());
          char text[80];
          std::snprintf(text, sizeof text, "  %3.0f %% of %s s", 100.0 * part, seconds_text(end).c_str());
          return std::string(text);
        }) {}

  /// The same of a line in words.
  Progress(bool shown, std::function<std::string()> line) {
    if (!shown) return;
    thread_ = std::thread([this, line = std::move(line)] {
      std::unique_lock lock(mutex_);
      while (!done_.wait_for(lock, std::chrono::milliseconds(200), [this] { return finished_; })) {
        std::fprintf(stderr, "\r%s\033[K", line().c_str());
        std::fflush(stderr);
      }
      std::fputs("\r\033[K", stderr);
    });
  }

  ~Progress() {
    if (!thread_.joinable()) return;
    {
      const std::lock_guard lock(mutex_);
      finished_ = true;
    }
    done_.notify_one();
    thread_.join();
  }

  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

 private:
  std::mutex mutex_;
  std::condition_variable done_;
  bool finished_ = false;
  std::thread thread_;
};

}  // namespace jarol::tools

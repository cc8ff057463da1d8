// What was found about files, found once in a process until a file changes.
#pragma once

#include <sys/stat.h>

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <tuple>
#include <utility>

namespace jarol {

/// Any thread asks; one judges at a time, and others wait for what it finds.
template <class Verdict>
class JudgedFiles {
 public:
  /// judge() of the file that stands there now; `what`: of what about it. What it throws is not kept.
  template <class Judge>
  Verdict find(const std::string& path, const std::string& what, Judge&& judge) {
    const std::lock_guard lock(mutex_);
    const Key key{path, what, identity_of(path)};
    if (const auto found = verdicts_.find(key); found != verdicts_.end()) return found->second;
    return verdicts_.emplace(key, judge()).first->second;
  }

 private:
  // device, number, size, and the times in ns of the last change of content and of anything else
  using Identity = std::tuple<dev_t, ino_t, off_t, std::int64_t, std::int64_t>;
  using Key = std::tuple<std::string, std::string, Identity>;

  static Identity identity_of(const std::string& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) return {};
    const auto ns = [](const timespec& time) { return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec; };
    return {status.st_dev, status.st_ino, status.st_size, ns(status.st_mtim), ns(status.st_ctim)};
  }

  std::mutex mutex_;
  std::map<Key, Verdict> verdicts_;
};

}  // namespace jarol

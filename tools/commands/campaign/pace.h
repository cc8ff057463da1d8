// How far a campaign is, and how long it still takes.
#pragma once

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>

#include "distributers/campaign/result.h"
#include "tools/commands/campaign/campaign_report.h"

namespace jarol::tools {

/// Counted by the threads that run, read by the one that shows it.
class CampaignPace {
 public:
  CampaignPace(std::uint64_t all, std::uint64_t to_run) : all_(all), to_run_(to_run) {}

  void count(const campaign::Result& result) {
    ran_.fetch_add(1, std::memory_order_relaxed);
    if (result.outcome != campaign::Outcome::good) not_good_.fetch_add(1, std::memory_order_relaxed);
  }
  std::uint64_t ran() const { return ran_.load(); }
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

  std::string line() const {
    const std::uint64_t ran = this->ran();
    std::string text = fmt::format("  {} of {} runs", all_ - to_run_ + ran, all_);
    if (not_good_.load() > 0) text += fmt::format(", {} not good", not_good_.load());
    if (ran == 0) return text;
    const double left = seconds() / static_cast<double>(ran) * static_cast<double>(to_run_ - ran);
    return text + ", " + clock_text(left) + " left";
  }

 private:
  std::uint64_t all_, to_run_;
  std::atomic<std::uint64_t> ran_{0}, not_good_{0};
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace jarol::tools

#include "runtime/execute/failsafe.h"

#include <algorithm>
#include <exception>

#include "graph/model/failsafe.h"

namespace jarol {

Failsafe::Failsafe(const Graph& graph)
    : graph_(graph), newest_(graph.communicators.size(), never), watches_(graph.communicators.size()) {
  for (std::size_t i = 0; i < watches_.size(); ++i) {
    if (!graph.communicators[i].safe) continue;
    watches_[i] = {watched_by(graph, graph.communicators[i]), reports_.size()};
    reports_.push_back({.communicator = i});
  }
}

const void* Failsafe::in_place_of_input(std::size_t out, Duration instant) {
  Watch& watch = watches_[out];
  if (watch.ins.empty()) return nullptr;
  FailsafeReport& report = reports_[watch.report];
  const auto unheard = [&](std::size_t in) { return newest_[in] == never; };
  const auto late = [&](std::size_t in) { return instant - newest_[in] > *graph_.communicators[in].timeout; };
  report.heard = report.heard || std::none_of(watch.ins.begin(), watch.ins.end(), unheard);
  const bool before = watch.in_force;
  watch.in_force = !report.heard || std::any_of(watch.ins.begin(), watch.ins.end(), late);
  if (!watch.in_force) return nullptr;
  if (!report.heard) {
    ++report.at_start;
  } else {
    if (!before || report.commands == 0) ++report.times;
    if (report.commands++ == 0) report.first = instant;
    report.last = instant;
  }
  return graph_.communicators[out].safe->data();
}

void Failsafe::serialize(Archive& archive) {
  for (Duration& newest : newest_) {
    archive(newest);
    archive.require(newest >= never && newest <= longest_duration, "has a time that there is not");
  }
  for (Watch& watch : watches_) archive(watch.in_force);
  for (FailsafeReport& report : reports_) archive(report);
}

template <class Do>
void Failsafe::at_end(std::span<const std::unique_ptr<ExternalSystem>> systems, Duration time, bool outliving, Do act) {
  for (FailsafeReport& report : reports_) {
    const Communicator& out = graph_.communicators[report.communicator];
    ExternalSystem& to = *systems[*out.distributer];
    if (outliving && !to.outlives_run()) continue;
    const std::uint64_t unsent = to.unsent();
    report.at_end = {.time = time, .failure = act(out, to), .unsent = unsent};
  }
}

void Failsafe::hand_over_at_end(std::span<const std::unique_ptr<ExternalSystem>> systems, Duration time,
                                bool outliving) {
  at_end(systems, time, outliving, [](const Communicator& out, ExternalSystem& to) -> std::string {
    try {
      to.hand_over(out.channel, out.safe->data());
      to.flush();
      return "";
    } catch (const std::exception& error) { return error.what(); } catch (...) {
      return "something was thrown that is no exception";
    }
  });
}

void Failsafe::fail_at_end(std::span<const std::unique_ptr<ExternalSystem>> systems, Duration time, bool outliving,
                           const std::string& why) {
  at_end(systems, time, outliving, [&](const Communicator&, ExternalSystem&) { return why; });
}

}  // namespace jarol

#include "runtime/execute/safe_commands.h"

#include <algorithm>
#include <exception>

#include "graph/model/safe_commands.h"

namespace jarol {

SafeCommands::SafeCommands(const Graph& graph)
    : graph_(graph), newest_(graph.communicators.size(), never), watches_(graph.communicators.size()) {
  for (std::size_t i = 0; i < watches_.size(); ++i) {
    if (!graph.communicators[i].safe) continue;
    watches_[i] = {watched_by(graph, graph.communicators[i]), reports_.size()};
    reports_.push_back({.communicator = i});
  }
}

const void* SafeCommands::in_place_of_input(std::size_t out, Duration instant) {
  Watch& watch = watches_[out];
  if (watch.ins.empty()) return nullptr;
  SafeCommandReport& report = reports_[watch.report];
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

void SafeCommands::serialize(Archive& archive) {
  for (Duration& newest : newest_) {
    archive(newest);
    archive.require(newest >= never && newest <= longest_duration, "has a time that there is not");
  }
  for (Watch& watch : watches_) archive(watch.in_force);
  for (SafeCommandReport& report : reports_) archive(report);
}

template <class Do>
void SafeCommands::at_end(std::span<const std::unique_ptr<Channels>> channels, Duration time, bool outliving, Do act) {
  for (SafeCommandReport& report : reports_) {
    const Communicator& out = graph_.communicators[report.communicator];
    Channels& to = *channels[*out.distributer];
    if (outliving && !to.outlives_run()) continue;
    report.at_end = {.time = time, .failure = act(out, to)};
  }
}

void SafeCommands::hand_over_at_end(std::span<const std::unique_ptr<Channels>> channels, Duration time,
                                    bool outliving) {
  at_end(channels, time, outliving, [](const Communicator& out, Channels& to) -> std::string {
    try {
      to.hand_over(out.channel, out.safe->data());
      to.flush();
      return "";
    } catch (const std::exception& error) { return error.what(); }
  });
}

void SafeCommands::fail_at_end(std::span<const std::unique_ptr<Channels>> channels, Duration time, bool outliving,
                               const std::string& why) {
  at_end(channels, time, outliving, [&](const Communicator&, Channels&) { return why; });
}

}  // namespace jarol

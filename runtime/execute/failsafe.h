// Time-outs of external systems while a graph runs: is one silent, and what do its actuators get then? It depends on
// what `in` communicators took at which logical instant, on nothing else.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "graph/model/graph.h"
#include "graph/values/archive.h"
#include "runtime/external_system.h"

namespace jarol {

/// How often a safe value was handed over in place of what the graph had computed.
struct FailsafeReport {
  std::size_t communicator = 0;
  bool heard = false;          // the external system reported something at all
  std::uint64_t at_start = 0;  // commands before it did
  std::uint64_t times = 0;     // that it fell silent after that
  std::uint64_t commands = 0;  // that were handed over meanwhile
  Duration first{}, last{};    // instants of these, if any
  // as no command follows
  struct AtEnd {
    Duration time{};           // since the start, by the run's clock
    std::string failure;       // why it could not be handed over; empty: it was
    std::uint64_t unsent = 0;  // of all that its external system was handed before
    bool is_alone = false;     // the failure: nobody was ever there
  };
  std::optional<AtEnd> at_end{};

  /// Before the end.
  void serialize(Archive& archive) { archive(heard, at_start, times, commands, first, last); }
};

/// Why a link may not be given a safe value at the end.
inline constexpr const char* busy_link_text = "the link has not done what it was given before";

/// Why a safe value that a link was given has not gone out.
inline constexpr const char* unsent_text = "the link had no room for it, or nobody to send it to any more";
inline constexpr const char* alone_text = "the link had nobody to send it to all along";

class Failsafe {
 public:
  /// The graph outlives it.
  explicit Failsafe(const Graph& graph);

  /// An `in` communicator has a new value.
  void took(std::size_t in, Duration instant) { newest_[in] = instant; }

  /// It has taken something, and not too long ago if it has a time-out.
  bool hears(std::size_t in, Duration instant) const {
    if (newest_[in] == never) return false;
    const std::optional<Duration>& timeout = graph_.communicators[in].timeout;
    return !timeout || instant - newest_[in] <= *timeout;
  }

  /// What an `out` communicator has to hand over now in place of its input, or null. A channel that never brought
  /// anything is silent from the start; else one whose newest value is older than its time-out.
  const void* in_place_of_input(std::size_t out, Duration instant);

  /// Hands over every safe value that there is: no command follows. What is published does not change by it. With
  /// `outliving` only to external systems that outlive the run.
  void hand_over_at_end(std::span<const std::unique_ptr<ExternalSystem>> systems, Duration time, bool outliving);
  /// It can't: notes why.
  void fail_at_end(std::span<const std::unique_ptr<ExternalSystem>> systems, Duration time, bool outliving,
                   const std::string& why);

  void serialize(Archive& archive);

  /// Per `out` communicator with a safe value, in their order.
  const std::vector<FailsafeReport>& reports() const { return reports_; }

 private:
  static constexpr Duration never{-1};

  struct Watch {
    std::vector<std::size_t> ins;
    std::size_t report = 0;
    bool in_force = false;
  };

  template <class Do>
  void at_end(std::span<const std::unique_ptr<ExternalSystem>> systems, Duration time, bool outliving, Do act);

  const Graph& graph_;
  std::vector<Duration> newest_;  // per communicator
  std::vector<Watch> watches_;    // per communicator; nothing to watch: no safe value
  std::vector<FailsafeReport> reports_;
};

}  // namespace jarol

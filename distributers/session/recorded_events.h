// What happened in a run beside its publications, as its recording has it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "distributers/session/verdict.h"
#include "runtime/record/recorded_stream.h"
#include "runtime/record/recording.h"

namespace jarol {

/// The instant of a fault is that at which it would have published.
struct TimedEvent {
  Duration instant{};
  RunEvent::Kind kind = RunEvent::Kind::fault;
  std::int64_t activation = 0;  // of a fault, as the others
  std::string task{}, cause{};  // of a mishap: the distributer whose vehicle it is, and what it has

  friend auto operator<=>(const TimedEvent&, const TimedEvent&) = default;
};

/// Of one that is no fault, in words.
std::string words_of(const TimedEvent& event);

/// At most so many; `more`: how many others there are.
struct RecordedEvents {
  static constexpr std::size_t max = 1'000'000;
  std::vector<TimedEvent> events;
  std::uint64_t more = 0;
};

/// In their order. Throws LogError.
RecordedEvents read_events(const Recording& recording);

/// What had become of vehicles by the end of the run. Throws LogError.
std::vector<RunVerdict::VehicleMishap> read_mishaps(const Recording& recording);

/// How the vehicle was brought to rest at the end of the run.
struct RecordedRest {
  Duration begun{};
  bool reached = false;  // as far as the recording goes
};

/// None: it was not, or that is not known. Throws LogError.
std::optional<RecordedRest> read_rest(const Recording& recording);

/// The digests of the run on its way, in their order. Throws LogError.
std::vector<RunningDigest> read_digests(const Recording& recording);
/// "at rest", "NOT AT REST"; of inputs alone it is not known.
std::string_view words_of(const std::optional<RecordedRest>& rest, bool is_whole);

/// What ended the run, as in "SIGINT ended the run"; empty: it came to its end. Throws LogError.
std::string read_ended_by(const Recording& recording);

}  // namespace jarol

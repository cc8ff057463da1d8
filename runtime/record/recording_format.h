// What stands in a recording beside published values: an MCAP file with topics of its own, and two kinds of
// attachments.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "graph/language/load.h"
#include "graph/model/graph.h"
#include "graph/text/errors.h"
#include "graph/values/describe.h"
#include "graph/values/sequence.h"

namespace jarol {

/// What can't be replayed or looked at, and why.
struct LogError : InputError {
  using InputError::InputError;
};

/// A recording that is not as it was written.
struct DamagedLog : LogError {
  using LogError::LogError;
};

/// The attachment that says of what run a recording is.
struct RecordingHeader {
  static constexpr const char* schema = "jarol.recording/1";
  static constexpr const char* attachment = "jarol.json";

  struct Input {
    std::string name;       // of an `in` communicator
    std::string signature;  // of its type
  };
  struct Truth {
    std::string distributer;  // whose vehicle it is
    std::string signature;    // of the type of its true values
  };

  std::string graph;
  std::string file;  // of the graph, from the root
  Overrides overrides;
  std::string clock;   // of the run: virtual or real
  Duration begin{};    // from which on it is recorded; above zero it went on there from what was saved
  Duration until{};    // what the run was to reach; the greatest there is: until it was ended
  Duration mission{};  // the end of the mission; zero: there was none, or it is not known
  std::uint64_t seed = 0;
  std::string execution{};      // what activations were given to take: wcet, random or a file; empty: nothing
  std::string what = "inputs";  // "all", "inputs", or names with * for any part
  std::string version{};        // of the program, a line each
  std::string platform{};       // on which it ran
  std::vector<Input> inputs{};
  std::vector<Truth> truths{};       // of vehicles that were simulated in the run
  std::vector<std::string> tasks{};  // a miss names one by its index here
  std::uint64_t split = 0;           // a new file begins at so many bytes; 0: never
  std::size_t part = 1;              // of the files, which this one is
  std::string follows{};             // the mark of the part before this one
};

/// Topics; those of published values are their names, in which no slash is.
namespace topics {
inline constexpr std::string_view own = "jarol/";  // what all others begin with
inline constexpr std::string_view taken = "jarol/taken/";
inline constexpr std::string_view truth = "jarol/truth/";
inline constexpr std::string_view misses = "jarol/misses";
inline constexpr std::string_view digests = "jarol/digests";
inline constexpr std::string_view rest = "jarol/rest";
inline constexpr std::string_view checkpoints = "jarol/checkpoints";
inline constexpr std::string_view end = "jarol/end";
inline constexpr std::string_view ended = "jarol/ended";
inline constexpr std::string_view events = "jarol/events";
inline constexpr std::string_view gaps = "jarol/gaps";
}  // namespace topics

/// How the run ended.
struct LogEnd {
  std::int64_t covered = 0;    // ns; the instants before it were run
  std::int64_t simulated = 0;  // ns; what the run reported that it went to
  std::uint64_t digest = 0;
  std::uint64_t activations = 0;
  std::uint64_t instants = 0;
  std::uint64_t faults = 0;

  static constexpr auto fields() {
    return describe(field<&LogEnd::covered>("ns"), field<&LogEnd::simulated>("ns"), field<&LogEnd::digest>(),
                    field<&LogEnd::activations>(), field<&LogEnd::instants>(), field<&LogEnd::faults>());
  }
};

/// Somebody ended the run on its way: a signal, and which, as a sentence.
struct EndedBy {
  String reason{};

  static constexpr auto fields() { return describe(field<&EndedBy::reason>()); }
};

/// The whole run between two instants, as a checkpoint has it.
struct SavedState {
  String bytes{};

  static constexpr auto fields() { return describe(field<&SavedState::bytes>()); }
};

/// Published values that came faster than the disk took them, on the real clock: those of these instants are not all in
/// the recording.
struct Gap {
  std::int64_t from = 0, to = 0;  // ns
  std::uint64_t values = 0;

  static constexpr auto fields() {
    return describe(field<&Gap::from>("ns"), field<&Gap::to>("ns"), field<&Gap::values>());
  }
};

/// Is it plugins that this "path=value" of Overrides sets? A recording has no such: it names no code to load.
bool names_plugins(const std::string& set);

/// As JSON, and back. Throws LogError.
std::string to_json(const RecordingHeader& header);
RecordingHeader parse_header(const std::string& json);

/// The same for types of the same layout.
std::string signature_of(const Type& type);

}  // namespace jarol

// A log: a line of JSON that says of what graph it is, then records in the order in which they came, the first of them
// of that line. Each is checked by a sum of its own, so that what breaks off or is damaged is good up to a checkpoint.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "graph/language/load.h"
#include "graph/model/graph.h"
#include "graph/values/digest.h"

namespace jarol {

/// What can't be replayed, and why.
struct LogError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct LogHeader {
  static constexpr const char* schema = "jarol.log/1";

  struct Input {
    std::string name;       // of an `in` communicator
    std::string signature;  // of its type
  };

  std::string graph;
  std::string file;      // of the graph, from the root
  std::string file_sum;  // of its text
  Overrides overrides;
  std::string clock;                 // of the run: virtual or real
  Duration until{};                  // what the run was to reach; the greatest there is: until it was ended
  Duration mission{};                // the end of the mission; zero: there was none, or it is not known
  std::vector<Input> inputs{};       // a record's `output` is an index into these
  std::vector<std::string> tasks{};  // a miss tells an index into these
};

/// Before the bytes of a record, in the byte order of the machine, which is that of all that Jarol runs on.
struct LogRecord {
  enum Kind : std::uint32_t { header = 0xfffffff0, miss, checkpoint, end, rest };  // beyond all inputs

  std::int64_t instant = 0;  // ns from the start
  std::uint32_t output = 0;  // index of an input, or a Kind
  std::uint32_t size = 0;    // bytes that follow
  std::uint64_t sum = 0;

  static std::uint64_t sum_of(const LogRecord& record, std::string_view bytes) {
    const std::uint64_t place = (std::uint64_t{record.output} << 32) | record.size;
    return digest::fold(digest::name_hash(bytes) ^ digest::key(0), static_cast<std::uint64_t>(record.instant) ^ place);
  }
};

/// How the run ended.
struct LogEnd {
  std::int64_t covered = 0;    // ns; the instants before it were run
  std::int64_t simulated = 0;  // ns; what the run told that it went to
  std::uint64_t digest = 0;
  std::uint64_t activations = 0;
  std::uint64_t instants = 0;
  std::uint64_t faults = 0;
};

/// Is it plugins that this "path=value" of Overrides sets? A log has no such: it names no code to load.
bool names_plugins(const std::string& set);

/// As one line of JSON, and back. Throws LogError.
std::string to_line(const LogHeader& header);
LogHeader parse_header(const std::string& line);

/// The same for types of the same layout.
std::string signature_of(const Type& type);

/// The same for the same text.
std::string sum_of_text(std::string_view text);

}  // namespace jarol

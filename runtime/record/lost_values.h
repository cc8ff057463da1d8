// What a recorder had no room for, until its sinks learn of it.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "runtime/record/record_header.h"
#include "runtime/record/sink.h"

namespace jarol {

class LostValues {
 public:
  void add(Duration instant, std::uint32_t output);
  /// All that stands in these bytes, as the recorder has it in memory.
  void add_all(const std::byte* records, std::size_t bytes);

  /// None: the sink has got all that it wants.
  std::optional<Loss> of(const RecordSink& sink) const;

 private:
  std::vector<std::optional<Loss>> by_output_;
};

}  // namespace jarol

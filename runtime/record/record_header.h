// What stands before each value that a recorder has in memory.
#pragma once

#include <cstdint>

#include "graph/language/duration.h"
#include "runtime/record/sink.h"

namespace jarol {

struct RecordHeader {
  Duration instant{};        // since the start
  std::uint32_t output = 0;  // index into Plan::outputs
  std::uint32_t size = 0;    // bytes of the value that follows, padded to 8

  static constexpr std::uint32_t event = 0xffffffff;  // stands for an event in place of an output
};

/// What stands before the cause of an event.
struct EventHeader {
  std::int64_t activation = 0;
  std::uint32_t task = 0;
  RunEvent::Kind kind{};
  std::uint64_t name = 0;  // so many bytes of the cause are the distributer's name
};

}  // namespace jarol

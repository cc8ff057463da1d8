// What stands before each value that a recorder has in memory.
#pragma once

#include <cstdint>

#include "graph/language/duration.h"

namespace jarol {

struct RecordHeader {
  Duration instant{};        // since the start
  std::uint32_t output = 0;  // index into Plan::outputs
  std::uint32_t size = 0;    // bytes of the value that follows, padded to 8

  static constexpr std::uint32_t event = 0xffffffff;  // stands for an event in place of an output
};

}  // namespace jarol

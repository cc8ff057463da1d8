// An instant, as those who act at it need it.
#pragma once

#include <cstdint>
#include <span>

#include "graph/values/type_of.h"

namespace jarol {

struct Now {
  Duration instant{};
  std::uint64_t digest_term = 0;         // what the digest's hashes of this instant share; 0 where there is none
  std::span<const std::uint32_t> due{};  // groups, in their order
};

}  // namespace jarol

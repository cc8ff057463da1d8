// Which part of a campaign this is.
#pragma once

#include <charconv>
#include <string>

#include "distributers/campaign/run_all.h"
#include "graph/text/errors.h"

namespace jarol::tools {

/// "2/8": the second of eight.
inline campaign::Shard shard_of(const std::string& text) {
  if (text.empty()) return {};
  campaign::Shard shard{0, 0};
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, shard.index);
  const auto second = first.ptr == end ? first : std::from_chars(first.ptr + 1, end, shard.count);
  if (first.ec != std::errc() || second.ec != std::errc() || second.ptr != end || *first.ptr != '/' ||
      shard.index < 1 || shard.index > shard.count)
    throw InputError("--shard: '" + text + "' is no part of a whole; write it as 2/8, the second of eight");
  --shard.index;
  return shard;
}

}  // namespace jarol::tools

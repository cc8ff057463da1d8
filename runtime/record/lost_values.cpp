#include "runtime/record/lost_values.h"

#include <algorithm>
#include <cstring>

namespace jarol {

void LostValues::add(Duration instant, std::uint32_t output) {
  if (output == RecordHeader::event) return;
  if (output >= by_output_.size()) by_output_.resize(output + std::size_t{1});
  std::optional<Loss>& loss = by_output_[output];
  if (!loss) loss = Loss{instant, instant, 0};
  loss->from = std::min(loss->from, instant);
  loss->to = std::max(loss->to, instant);
  ++loss->values;
}

void LostValues::add_all(const std::byte* records, std::size_t bytes) {
  RecordHeader header;
  for (std::size_t at = 0; at < bytes; at += sizeof header + ((header.size + 7U) & ~std::size_t{7})) {
    std::memcpy(&header, records + at, sizeof header);
    add(header.instant, header.output);
  }
}

std::optional<Loss> LostValues::of(const RecordSink& sink) const {
  std::optional<Loss> all;
  for (std::uint32_t output = 0; output < by_output_.size(); ++output) {
    const std::optional<Loss>& loss = by_output_[output];
    if (!loss || !sink.wants(output)) continue;
    if (!all) all = Loss{loss->from, loss->to, 0};
    all->from = std::min(all->from, loss->from);
    all->to = std::max(all->to, loss->to);
    all->values += loss->values;
  }
  return all;
}

}  // namespace jarol

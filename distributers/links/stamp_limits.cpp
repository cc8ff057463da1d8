#include "distributers/links/stamp_limits.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace jarol::distributers {

using messages::Wire;

StampLimits::StampLimits(const messages::MessageSet& set, std::chrono::nanoseconds silence) : silence_(silence) {
  for (const messages::FieldDescriptor& field : set.header->fields) {
    if (field.name == "timestamp" && field.wire == Wire::fp64) time_ = &field;
    if (field.name == "src" && field.wire <= Wire::uint64) source_ = &field;
  }
}

StampLimits::Source& StampLimits::find(std::uint64_t id) {
  const auto found =
      std::find_if(sources_.begin(), sources_.end(), [&](const Source& s) { return s.used && s.id == id; });
  if (found != sources_.end()) return *found;
  Source& oldest = *std::min_element(sources_.begin(), sources_.end(), [](const Source& a, const Source& b) {
    return a.used != b.used ? b.used : a.taken < b.taken;
  });
  oldest = {false, id, 0, {}};
  return oldest;
}

StampLimits::Finding StampLimits::look(messages::MessageRef header, Clock::time_point now, double here) {
  if (time_ == nullptr) return Finding::good;
  const auto* const fields = static_cast<const std::byte*>(header.value);
  double stamp = 0;
  std::uint64_t id = 0;
  std::memcpy(&stamp, fields + time_->offset, sizeof stamp);
  if (source_ != nullptr) std::memcpy(&id, fields + source_->offset, size_of(source_->wire));
  if (!(stamp >= earliest && stamp < latest)) return Finding::no_time;
  Source& source = find(id);
  const auto seconds = [](auto duration) { return std::chrono::duration<double>(duration).count(); };
  const double lead = stamp - seconds(now.time_since_epoch());
  const bool known = source.used && now - source.taken < silence_;
  if (known) {
    const double last = source.lead + seconds(now.time_since_epoch());  // what its clock shows now
    if (stamp > last + seconds(max_ahead) && std::abs(stamp - here) >= std::abs(last - here)) return Finding::ahead;
    if (stamp < last - seconds(max_behind)) return Finding::behind;
  }
  source = {true, id, known ? std::max(lead, source.lead) : lead, now};
  return Finding::good;
}

}  // namespace jarol::distributers

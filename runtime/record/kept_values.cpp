#include "runtime/record/kept_values.h"

#include <algorithm>

#include "runtime/record/ros2msg.h"

namespace jarol {

KeptValues::KeptValues(std::vector<Output> outputs, Duration from) : from_(from) {
  for (Output& output : outputs) {
    MessageLayout layout(output.name, schema_of(*output.type).text);
    lanes_.push_back({std::move(output.name), CdrEncoder(*output.type), std::move(layout)});
  }
}

void KeptValues::take(Duration instant, std::uint32_t output, const void* value) {
  if (instant >= from_ && wants(output)) append(instant, output, value, published_, bytes_);
}

void KeptValues::append(Duration instant, std::uint32_t output, const void* value, std::vector<Published>& published,
                        std::string& bytes) const {
  const CdrEncoder& encoder = lanes_[output].encoder;
  const std::size_t begin = bytes.size(), size = encoder.size(value);
  bytes.resize(begin + size);
  encoder.encode(value, reinterpret_cast<std::byte*>(bytes.data()) + begin);
  published.push_back({instant, output, begin, size});
}

ComparedValues::ComparedValues(const KeptValues& run, Duration from) : run_(run) {
  const auto earlier = [](const Published& p, Duration instant) { return p.instant < instant; };
  next_ = static_cast<std::size_t>(std::lower_bound(run.published_.begin(), run.published_.end(), from, earlier) -
                                   run.published_.begin());
}

void ComparedValues::take(Duration instant, std::uint32_t output, const void* value) {
  if (!wants(output)) return;
  if (!published_.empty() && instant != published_.front().instant) compare_before(instant);
  run_.append(instant, output, value, published_, bytes_);
}

// All that either of them published until then.
void ComparedValues::compare_before(Duration end) {
  for (;;) {
    Duration instant = end;
    if (next_ < run_.published_.size()) instant = std::min(instant, run_.published_[next_].instant);
    if (!published_.empty()) instant = std::min(instant, published_.front().instant);
    if (instant == end) return;
    compare_instant(instant);
  }
}

std::vector<KeptValues::Published> ComparedValues::next_of_run(Duration instant) {
  std::vector<Published> all;
  for (; next_ < run_.published_.size() && run_.published_[next_].instant == instant; ++next_)
    all.push_back(run_.published_[next_]);
  return all;
}

// Who publishes first within an instant depends on the number of workers.
void ComparedValues::compare_instant(Duration instant) {
  std::vector<Published> was = next_of_run(instant), is;
  if (!published_.empty() && published_.front().instant == instant) is.swap(published_);
  const auto by_output = [](const Published& a, const Published& b) { return a.output < b.output; };
  std::sort(was.begin(), was.end(), by_output);
  std::sort(is.begin(), is.end(), by_output);
  const auto text = [](const std::string& bytes, const Published& of) {
    return std::string_view(bytes).substr(of.begin, of.size);
  };
  auto w = was.begin();
  auto i = is.begin();
  while (w != was.end() || i != is.end()) {
    const bool in_run = w != was.end() && (i == is.end() || w->output <= i->output);
    const bool in_other = i != is.end() && (w == was.end() || i->output <= w->output);
    const KeptValues::Lane& lane = run_.lanes_[in_run ? w->output : i->output];
    std::string_view before, now;
    if (in_run) before = text(run_.bytes_, *w++);
    if (in_other) now = text(bytes_, *i++);
    differences_.compare(instant, lane.name, lane.layout, in_run ? &before : nullptr, in_other ? &now : nullptr);
  }
  if (published_.empty()) bytes_.clear();
}

}  // namespace jarol

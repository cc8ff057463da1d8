#include "runtime/record/fed_sinks.h"

#include <algorithm>
#include <cstring>
#include <string_view>

#include "graph/values/pack.h"

namespace jarol {
namespace {
// So many bytes are read after those at hand.
constexpr std::size_t ahead = 1024;
}  // namespace

void FedSinks::expect(const std::vector<Output>& outputs) {
  deep_values_.clear();
  for (const Output& output : outputs) deep_values_.push_back(output.type->is_deep() ? Value(*output.type) : Value());
}

bool FedSinks::want(std::uint32_t output) const {
  return std::any_of(taking_.begin(), taking_.end(), [&](const RecordSink* sink) { return sink->wants(output); });
}

void FedSinks::take(const std::byte* records, std::size_t bytes) {
  if (taking_.empty()) return;  // the ring is emptied all the same, so that the run itself is not held up
  try {
    for (std::size_t at = 0; at < bytes;) {
      // on its way from another core's cache, two lines for each value
      for (const std::size_t line : {ahead, ahead + 64}) __builtin_prefetch(records + std::min(at + line, bytes));
      RecordHeader header;
      std::memcpy(&header, records + at, sizeof header);
      const std::byte* packed = records + at + sizeof header;
      disorder_ ? hold(header, packed) : hand_on(header, packed);
      at += sizeof header + ((header.size + 7U) & ~std::size_t{7});
    }
    each_taking([](RecordSink& sink) { sink.pause(); });
  } catch (...) { fail_all(); }
}

void FedSinks::finish(const LostValues& lost) {
  try {
    if (!taking_.empty()) hand_on_held(newest_);
  } catch (...) { fail_all(); }
  each_taking([&](RecordSink& sink) {
    if (const auto loss = lost.of(sink)) sink.take_loss(*loss);
    sink.finish();
  });
}

template <class Call>
void FedSinks::each_taking(const Call& call) {
  for (std::size_t i = 0; i < taking_.size();) {
    try {
      for (; i < taking_.size(); ++i) call(*taking_[i]);
    } catch (...) {
      failures_.note(taking_[i]);
      taking_.erase(taking_.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }
}

// While it is caught.
void FedSinks::fail_all() {
  failures_.note(nullptr);
  taking_.clear();
}

void FedSinks::hold(const RecordHeader& header, const std::byte* packed) {
  held_.emplace(header.instant, Held{header, {packed, packed + header.size}});
  newest_ = std::max(newest_, header.instant);
  hand_on_held(newest_ - *disorder_);
}

void FedSinks::hand_on_held(Duration until) {
  for (auto first = held_.begin(); first != held_.end() && first->first <= until; first = held_.erase(first))
    hand_on(first->second.header, first->second.packed.data());
}

void FedSinks::hand_on_event(const RecordHeader& header, const std::byte* packed) {
  EventHeader event;
  std::memcpy(&event, packed, sizeof event);
  const std::string_view words(reinterpret_cast<const char*>(packed) + sizeof event, header.size - sizeof event);
  const std::size_t name = std::min<std::size_t>(event.name, words.size());
  each_taking([&](RecordSink& sink) {
    sink.take_event(
        {event.kind, header.instant, event.task, event.activation, words.substr(name), words.substr(0, name)});
  });
}

void FedSinks::hand_on(const RecordHeader& header, const std::byte* packed) {
  if (header.output == RecordHeader::event) return hand_on_event(header, packed);
  const void* value = value_of(header, packed);
  each_taking([&](RecordSink& sink) { sink.take(header.instant, header.output, value); });
}

const void* FedSinks::value_of(const RecordHeader& header, const std::byte* packed) {
  if (header.output >= deep_values_.size() || deep_values_[header.output].type() == nullptr) return packed;
  Value& value = deep_values_[header.output];
  unpack(*value.type(), packed, value.data());
  return value.data();
}

}  // namespace jarol

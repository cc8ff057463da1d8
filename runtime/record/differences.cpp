#include "runtime/record/differences.h"

#include <fmt/format.h>
#include <algorithm>

#include "graph/language/quantities.h"
#include "graph/text/escape.h"

namespace jarol {

void Differences::compare(Duration instant, const std::string& output, const MessageLayout& layout,
                          const std::string_view* was, const std::string_view* is) {
  const bool both = was != nullptr && is != nullptr;
  if (both) ++compared_;
  if (both && *was == *is) return;
  if (was == nullptr || is == nullptr) {
    if (!first_)
      first_ = {instant, output, "", was != nullptr ? "published" : "nothing", is != nullptr ? "published" : "nothing"};
    return count(output, "", instant, std::nullopt);
  }
  const std::vector<MessageCell> before = layout.read(*was), now = layout.read(*is);
  for (std::size_t i = 0; i < before.size(); ++i) {
    const MessageColumn& column = layout.columns()[i];
    if (before[i].bits == now[i].bits && before[i].text == now[i].text) continue;
    if (!first_) {
      first_ = {instant, output, column.path, text_of(column, before[i]), text_of(column, now[i])};
      if (!column.is_sequence) {
        first_->was_bits = bits_text(column.kind, before[i].bits);
        first_->is_bits = bits_text(column.kind, now[i].bits);
      }
    }
    count(column.path.empty() ? output : output + "." + column.path, column.unit, instant,
          column.is_sequence ? std::nullopt : std::optional(distance(column.kind, before[i].bits, now[i].bits)));
  }
}

void Differences::count(const std::string& name, const std::string& unit, Duration instant,
                        std::optional<double> distance) {
  const auto [at, is_new] = signals_.try_emplace(name, SignalDifference{name, unit, 0, instant});
  SignalDifference& signal = at->second;
  ++signal.values;
  if (!distance || (signal.largest && *distance <= *signal.largest)) return;
  signal.largest = distance;
  signal.largest_at = instant;
}

std::vector<SignalDifference> Differences::signals() const {
  std::vector<SignalDifference> all;
  for (const auto& [name, signal] : signals_) all.push_back(signal);
  std::stable_sort(all.begin(), all.end(),
                   [](const SignalDifference& a, const SignalDifference& b) { return a.first < b.first; });
  return all;
}

std::string text_of(const FirstDifference& first) {
  const auto with_bits = [](const std::string& text, const std::string& bits) {
    return printable(text) + (bits.empty() ? "" : " (" + bits + ")");
  };
  return (first.field.empty() ? first.output : first.output + "." + first.field) + " at " +
         seconds_text(first.instant) + " s: was " + with_bits(first.was, first.was_bits) + ", is " +
         with_bits(first.is, first.is_bits);
}

std::string text_of(const SignalDifference& signal) {
  std::string text = "from " + seconds_text(signal.first) + " s on";
  if (!signal.largest) return text + ", " + std::to_string(signal.values) + (signal.values == 1 ? " value" : " values");
  return text + fmt::format(", by at most {}{} at {} s", *signal.largest, signal.unit.empty() ? "" : " " + signal.unit,
                            seconds_text(signal.largest_at));
}

}  // namespace jarol

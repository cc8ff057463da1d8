#include "distributers/session/logged_texts.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "runtime/plan/output.h"

namespace jarol {

LoggedTexts::LoggedTexts(const Graph& graph) {
  const std::vector<jarol::Output> all = outputs_of(graph);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].type->kind == Kind::string && all[i].name.find('.') != std::string::npos)
      outputs_.push_back({.index = static_cast<std::uint32_t>(i), .name = all[i].name});
}

const LoggedTexts::Output* LoggedTexts::find(std::uint32_t index) const {
  const auto found = std::lower_bound(outputs_.begin(), outputs_.end(), index,
                                      [](const Output& output, std::uint32_t i) { return output.index < i; });
  return found != outputs_.end() && found->index == index ? &*found : nullptr;
}

void LoggedTexts::take(Duration instant, std::uint32_t index, const void* value) {
  const Output* const found = find(index);
  if (found == nullptr) return;
  const std::string_view text = *static_cast<const String*>(value);
  const std::lock_guard lock(mutex_);
  Output& output = outputs_[static_cast<std::size_t>(found - outputs_.data())];
  if (text == output.last) return;
  output.last = text;
  if (text.empty()) return;
  if (++output.count > max_kept) return;
  // workers publish the outputs of one instant in any order
  const auto is_before = [](const Text& a, const Text& b) {
    return std::tie(a.instant, a.output) < std::tie(b.instant, b.output);
  };
  Text logged{instant, output.name, output.last};
  const auto at = std::upper_bound(kept_.begin(), kept_.end(), logged, is_before);
  kept_.insert(at, std::move(logged));
}

void LoggedTexts::serialize(Archive& archive) {
  const std::lock_guard lock(mutex_);
  archive.same(outputs_.size(), "is of other outputs");
  for (Output& output : outputs_) archive(output.last, output.count);
  archive(kept_);
}

LoggedTexts::Kept LoggedTexts::kept() const {
  const std::lock_guard lock(mutex_);
  Kept all{kept_, {}};
  for (const Output& output : outputs_)
    if (output.count > max_kept) all.more.emplace_back(output.name, output.count - max_kept);
  return all;
}

}  // namespace jarol

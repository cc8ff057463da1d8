#include "distributers/lauv/tuple_list.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace jarol::distributers {

TupleList::TupleList(std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(';'), text.size());
    const std::string_view part = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::size_t equals = part.find('=');
    if (equals != std::string_view::npos) pairs_.emplace_back(part.substr(0, equals), part.substr(equals + 1));
  }
}

std::optional<double> TupleList::number(std::string_view name) const {
  for (const auto& [its_name, text] : pairs_) {
    if (its_name != name) continue;
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(number)) return std::nullopt;
    return number;
  }
  return std::nullopt;
}

}  // namespace jarol::distributers

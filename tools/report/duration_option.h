// Options that are durations.
#pragma once

#include <stdexcept>
#include <string>

#include "graph/language/quantities.h"

namespace jarol::tools {

/// Throws std::invalid_argument with the option's name, as all here do.
inline Duration duration_of(const std::string& option, const std::string& text) {
  Duration time{};
  if (const std::string wrong = parse_duration(text, time); !wrong.empty())
    throw std::invalid_argument(option + ": '" + text + "' " + wrong);
  return time;
}

/// One above zero.
inline Duration length_of(const std::string& option, const std::string& text) {
  const Duration length = duration_of(option, text);
  if (length <= Duration{}) throw std::invalid_argument(option + ": '" + text + "' is not above zero");
  return length;
}

}  // namespace jarol::tools

// Options that are durations.
#pragma once

#include <string>

#include "graph/language/quantities.h"
#include "graph/text/errors.h"

namespace jarol::tools {

/// Throws InputError with the option's name, as all here do.
inline Duration duration_of(const std::string& option, const std::string& text) {
  Duration time{};
  if (const std::string wrong = parse_duration(text, time); !wrong.empty())
    throw InputError(option + ": '" + text + "' " + wrong);
  return time;
}

/// One above zero.
inline Duration length_of(const std::string& option, const std::string& text) {
  const Duration length = duration_of(option, text);
  if (length <= Duration{}) throw InputError(option + ": '" + text + "' is not above zero");
  return length;
}

}  // namespace jarol::tools

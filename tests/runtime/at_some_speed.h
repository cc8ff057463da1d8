// What happens in real time, tested on a machine that may be late for reasons of its own: again, and more slowly.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "graph/language/quantities.h"
#include "runtime/execute/executor.h"

namespace jarol::tests {

/// Calls `attempt` with 1, 1, 1, 2, 2, 2, 4, ... until it returns true: it runs so many times as slowly, so that what a
/// busy machine takes matters less and less. False if it never did.
template <class Attempt>
bool at_some_speed(const Attempt& attempt) {
  for (int times = 1; times <= 256; times *= 2)
    for (int i = 0; i < (times < 8 ? 3 : 1); ++i)
      if (attempt(times)) return true;
  return false;
}

/// The text with each duration in it, as in "20ms", replaced by what `change` makes of it.
template <class Change>
std::string with_durations(const std::string& text, const Change& change) {
  const std::string digits = "0123456789.", letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_";
  std::string changed;
  for (std::size_t at = 0; at < text.size();) {
    // a number, if it begins here, and its unit; else a word or what is between words
    const bool begins = at == 0 || (letters + digits).find(text[at - 1]) == std::string::npos;
    const std::size_t unit = std::min(text.size(), text.find_first_not_of(digits, at));
    const std::size_t end = std::min(text.size(), text.find_first_not_of(letters, unit));
    Duration duration{};
    if (begins && unit > at && parse_duration(text.substr(at, end - at), duration).empty()) {
      changed += duration_text(change(duration));
      at = end;
    } else {
      changed += text[at++];
    }
  }
  return changed;
}

/// A graph's text whose durations are so many times as long.
inline std::string slowed(const std::string& text, int times) {
  return with_durations(text, [&](Duration duration) { return times * duration; });
}

/// What a run reported that was so many times as slow, as it would have reported it at full speed.
inline void at_full_speed(Report& report, int times) {
  report.simulated /= times;
  for (Fault& fault : report.faults) {
    fault.instant /= times;
    fault.cause = with_durations(fault.cause, [&](Duration duration) { return duration / times; });
  }
}

/// Activations that were late or left out, sorted: "late: a 2, b 2; left out: a 3".
inline std::string misses_of(const Report& report) {
  std::string text;
  for (const std::string kind : {"late", "left out"}) {
    std::vector<std::string> found;
    for (const Fault& fault : report.faults)
      if (fault.cause.starts_with(kind + ": ")) found.push_back(fault.task + " " + std::to_string(fault.activation));
    std::sort(found.begin(), found.end());
    for (std::size_t i = 0; i < found.size(); ++i) {
      const std::string begin = (text.empty() ? "" : "; ") + kind + ": ";
      text += (i == 0 ? begin : ", ") + found[i];
    }
  }
  return text;
}

}  // namespace jarol::tests

#include "tools/commands/run/what_if.h"

#include "graph/language/override.h"
#include "graph/text/errors.h"
#include "tools/report/duration_option.h"

namespace jarol::tools {
namespace {

constexpr std::size_t max_count = 4;
constexpr std::string_view example = "; write it as in 'at=30s set=tasks.depth.parameters.kp=0.2'";

WhatIf parse_what_if(const std::string& words) {
  const auto fail = [&](const std::string& wrong) -> InputError {
    return InputError("--what-if: '" + words + "' " + wrong + std::string(example));
  };
  std::vector<std::size_t> sets;
  for (std::size_t at = words.find(" set="); at != std::string::npos; at = words.find(" set=", at + 1))
    sets.push_back(at);
  if (!words.starts_with("at=") || sets.empty()) throw fail("does not say when and what");
  WhatIf made;
  made.at = duration_of("--what-if", words.substr(3, sets.front() - 3));
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const std::size_t begin = sets[i] + 5, end = i + 1 < sets.size() ? sets[i + 1] : words.size();
    made.set.push_back(words.substr(begin, end - begin));
    if (!sets_parameters(made.set.back()) || made.set.back().find('=') == std::string::npos)
      throw fail("sets '" + made.set.back() + "', which is no parameter of a task");
  }
  return made;
}

}  // namespace

std::vector<WhatIf> parse_what_ifs(const std::vector<std::string>& words) {
  if (words.size() > max_count)
    throw InputError("--what-if: there are " + std::to_string(words.size()) + " of them, and at most " +
                     std::to_string(max_count) + " stand side by side");
  std::vector<WhatIf> all;
  for (const std::string& each : words) all.push_back(parse_what_if(each));
  return all;
}

}  // namespace jarol::tools

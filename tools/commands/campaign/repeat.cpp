#include "tools/commands/campaign/repeat.h"

#include "graph/text/shell_word.h"

namespace jarol::tools {

std::string repeat_command(const std::string& file, const Overrides& overrides, std::optional<Duration> length,
                           const campaign::Start& start) {
  std::string command = "jarol run " + shell_word(file);
  if (!overrides.profile.empty()) command += " --profile " + shell_word(overrides.profile);
  for (const auto* changes : {&overrides.set, &start.set})
    for (const std::string& change : *changes) command += " --set " + shell_word(change);
  command += " --seed " + std::to_string(start.seed);
  return length ? command + " --for " + seconds_text(*length) + "s" : command;
}

}  // namespace jarol::tools

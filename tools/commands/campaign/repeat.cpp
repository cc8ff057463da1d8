#include "tools/commands/campaign/repeat.h"

namespace jarol::tools {

std::string shell_word(const std::string& text) {
  constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./=:+,@%-";
  if (!text.empty() && text.find_first_not_of(plain) == std::string::npos) return text;
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string{c};
  return word + "'";
}

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

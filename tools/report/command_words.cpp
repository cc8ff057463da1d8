#include "tools/report/command_words.h"

#include <algorithm>
#include <iterator>

#include "graph/language/problems.h"

namespace jarol::tools {

std::vector<OptionWord> options_among(const CLI::App& command, const std::vector<std::string>& words) {
  const auto options = command.get_options();
  const auto find = [&](const std::string& name) -> const CLI::Option* {
    const auto found =
        std::find_if(options.begin(), options.end(), [&](const CLI::Option* o) { return o->check_name(name); });
    return found == options.end() ? nullptr : *found;
  };
  std::vector<OptionWord> found;
  for (auto word = words.begin(); word != words.end(); ++word) {
    if (*word == "--") break;  // what follows are arguments
    if (word->size() < 2 || (*word)[0] != '-' || word->find_first_of("0123456789.") == 1) continue;
    const std::size_t equals = word->find('=');
    OptionWord& at = found.emplace_back();
    at.name = word->substr(0, equals);
    at.option = find(at.name);
    if (equals != std::string::npos) at.joined = word->substr(equals + 1);
    if (at.option == nullptr && !word->starts_with("--")) {  // as in -oFOLDER
      at.option = find(word->substr(0, 2));
      if (at.option != nullptr) at.joined = word->substr(2);
    }
    // what follows is its value, whatever it looks like
    const bool takes_next = at.option != nullptr && at.option->get_items_expected_min() > 0 && !at.joined;
    if (takes_next && std::next(word) != words.end()) ++word;
  }
  return found;
}

// CLI11 takes --json=false for no flag, and --json=3 for one.
std::string flag_with_value(const CLI::App& command, const std::vector<std::string>& words) {
  for (const OptionWord& word : options_among(command, words))
    if (word.option != nullptr && word.option->get_items_expected_max() == 0 && word.joined &&
        word.option->get_type_name().empty())
      return word.name + " takes no value, and has '" + *word.joined + "'; write " + word.name +
             " alone, or leave it out";
  return "";
}

std::string unknown_option(const CLI::App& command, const std::vector<std::string>& words) {
  for (const OptionWord& word : options_among(command, words)) {
    if (word.option != nullptr) continue;
    std::vector<std::string> known;
    for (const CLI::Option* option : command.get_options())
      if (!option->get_positional()) known.push_back(option->get_name());
    return command.get_name() + " has no option '" + word.name + "'" +
           (word.name.starts_with("--") ? did_you_mean(word.name, known) : "") + "; it has: " + list_of(known);
  }
  return "";
}

std::string argument_too_many(const CLI::App& command, const std::string& argument,
                              const std::vector<std::string>& words) {
  std::vector<std::string> taken;
  for (const CLI::Option* option : command.get_options())
    if (option->get_positional()) taken.push_back(option->get_name());
  std::string text = command.get_name() + " takes " +
                     (taken.empty() ? "no argument" : list_of(taken) + " and no more") + ", and has '" + argument + "'";
  const auto at = std::find(words.begin(), words.end(), argument);
  if (at == words.begin() || at == words.end()) return text;
  const std::string& before = *std::prev(at);
  const std::vector<OptionWord> options = options_among(command, words);
  const bool follows_flag = std::any_of(options.begin(), options.end(), [&](const OptionWord& word) {
    return word.name == before && word.option != nullptr && word.option->get_items_expected_max() == 0;
  });
  return follows_flag ? text + " behind " + before + ", which takes no value" : text;
}

}  // namespace jarol::tools

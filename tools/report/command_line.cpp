#include "tools/report/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "graph/text/errors.h"
#include "tools/report/command_words.h"
#include "tools/report/failure.h"

namespace jarol::tools {
namespace {

// CLI11 reads 010 as eight, takes -1 as the largest number there is, and what is too large as something else.
template <class T>
std::string wrong_integer(const std::string& text) {
  T value{};
  const auto end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  const std::size_t first = text.starts_with('-') ? 1 : 0;
  const bool zero_in_front = text.size() > first + 1 && text[first] == '0';
  if (result.ec == std::errc() && result.ptr == end && !zero_in_front) return "";
  return "'" + text + "' is no whole number from " + std::to_string(std::numeric_limits<T>::min()) + " to " +
         std::to_string(std::numeric_limits<T>::max()) + "; write it in decimal, without zeros in front";
}

// A range of CLI11 lets NaN pass.
std::string wrong_number(const std::string& text) {
  double value = 0;
  const auto end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  if (result.ec == std::errc() && result.ptr == end && std::isfinite(value)) return "";
  return "'" + text + "' is no finite number in decimal; write it as in 20 or 0.5";
}

// As of a variable of the shell that is not set: it would be taken as if the option were not there.
std::string wrong_text(const std::string& text) {
  return text.empty() ? "'' says nothing; leave the option out, or give it something" : "";
}

}  // namespace

Option* Option::required() {
  option_.required();
  return this;
}

Option* Option::one_value() {
  option_.allow_extra_args(false);
  return this;
}

Option* Option::in_range(int min, int max) {
  option_.check(CLI::Range(min, max));
  return this;
}

Option* Option::in_range(double min, double max) {
  option_.check(CLI::Range(min, max));
  return this;
}

Option* Option::one_of(const std::vector<std::string>& words) {
  option_.check(CLI::IsMember(words));
  return suggests(words);
}

Option* Option::suggests(const std::vector<std::string>& words) {
  words_ = words;
  return this;
}

Option* Option::file(const std::vector<std::string>& extensions) {
  is_file_ = true;
  extensions_ = extensions;
  return this;
}

Option* Option::folder() {
  is_folder_ = true;
  return this;
}

OptionText Option::describe() const {
  const bool is_argument = option_.get_positional();
  return {.names = is_argument ? option_.get_name(true) : option_.get_name(false, true),
          .text = option_.get_description(),
          .is_argument = is_argument,
          .is_required = option_.get_required(),
          .takes_value = option_.get_items_expected_max() > 0,
          .repeats = option_.get_items_expected_max() > 1,
          .words = words_,
          .is_file = is_file_,
          .extensions = extensions_,
          .is_folder = is_folder_};
}

Option* Option::excludes(const Option* other) {
  option_.excludes(&other->option_);
  return this;
}

template <class T>
Option* Command::add_option(const std::string& name, T& value, const std::string& text) {
  CLI::Option& option = *app_.add_option(name, value, text);
  if constexpr (std::is_integral_v<T>) option.check(wrong_integer<T>);
  if constexpr (std::is_floating_point_v<T>) option.check(wrong_number);
  if constexpr (!std::is_arithmetic_v<T>) option.check(wrong_text);
  return &options_.emplace_back(option);
}
template Option* Command::add_option(const std::string&, std::string&, const std::string&);
template Option* Command::add_option(const std::string&, std::vector<std::string>&, const std::string&);
template Option* Command::add_option(const std::string&, int&, const std::string&);
template Option* Command::add_option(const std::string&, std::uint64_t&, const std::string&);
template Option* Command::add_option(const std::string&, double&, const std::string&);

Option* Command::add_option(const std::string& name, const std::function<void(const std::string&)>& take,
                            const std::string& text) {
  CLI::Option& option = *app_.add_option_function<std::string>(name, take, text);
  option.check(wrong_text);
  return &options_.emplace_back(option);
}

Option* Command::add_flag(const std::string& name, bool& value, const std::string& text) {
  return &options_.emplace_back(*app_.add_flag(name, value, text));
}

Option* Command::add_flag(const std::string& name, const std::function<void()>& take, const std::string& text) {
  return &options_.emplace_back(*app_.add_flag_callback(name, take, text));
}

Option* Command::add_flag_with_value(const std::string& name, std::string& value, const std::string& value_name,
                                     const std::string& text) {
  CLI::Option& option = *app_.add_flag(name, value, text);
  option.type_name("[=" + value_name + "]");
  return &options_.emplace_back(option);
}

bool Command::given(const std::string& name) const { return app_.count(name) > 0; }

void Command::refuse(const std::vector<std::string>& names, const std::string& why) const {
  for (const std::string& name : names)
    if (given(name)) throw InputError(name + " " + why);
}

void Command::footer(const std::string& text) { app_.footer(text); }

void Command::callback(const std::function<void()>& action) { app_.callback(action); }

CommandText Command::describe() const {
  CommandText made{app_.get_name(), app_.get_description(), app_.get_footer(), {}};
  for (const bool arguments : {true, false}) {
    if (!arguments)
      if (const CLI::Option* help = app_.get_help_ptr())
        made.options.push_back(Option(*app_.get_option(help->get_name())).describe());
    for (const Option& option : options_)
      if (OptionText text = option.describe(); text.is_argument == arguments) made.options.push_back(std::move(text));
  }
  return made;
}

CommandLine::CommandLine(const std::string& name, const std::string& text, const std::string& version)
    : app_(std::make_unique<CLI::App>(text, name)) {
  app_->require_subcommand(1);
  app_->set_version_flag("-V,--version", version);
}

CommandLine::~CommandLine() = default;
CommandLine::CommandLine(CommandLine&&) noexcept = default;

Command* CommandLine::add_subcommand(const std::string& name, const std::string& text) {
  return &commands_.emplace_back(*app_->add_subcommand(name, text));
}

std::vector<std::string> CommandLine::names() const {
  std::vector<std::string> names;
  for (const CLI::App* command : app_->get_subcommands({})) names.push_back(command->get_name());
  return names;
}

std::string CommandLine::help() const { return app_->help(); }

std::string CommandLine::text() const { return app_->get_description(); }

std::vector<CommandText> CommandLine::describe() const {
  std::vector<CommandText> made;
  for (const Command& command : commands_) made.push_back(command.describe());
  return made;
}

// The command, and the words behind its name.
struct CommandLine::Words {
  const CLI::App* command = nullptr;  // the whole, if none is named
  std::vector<std::string> own;
};

CommandLine::Words CommandLine::split(int argc, char** argv) const {
  const std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  for (const CLI::App* one : app_->get_subcommands({}))
    if (!words.empty() && one->get_name() == words.front()) return {one, {words.begin() + 1, words.end()}};
  return {app_.get(), words};
}

bool CommandLine::asks_for_json(int argc, char** argv) const {
  const Words words = split(argc, argv);
  // where there is no such command the word itself has to do
  if (words.command == app_.get()) return std::find(words.own.begin(), words.own.end(), "--json") != words.own.end();
  const std::vector<OptionWord> options = options_among(*words.command, words.own);
  return std::any_of(options.begin(), options.end(), [](const OptionWord& word) {
    return word.option != nullptr && word.option->check_name("--json") && !word.joined;
  });
}

void CommandLine::parse(int argc, char** argv) {
  const Words words = split(argc, argv);
  if (const std::string wrong = flag_with_value(*words.command, words.own); !wrong.empty()) throw UsageError(wrong);
  try {
    app_->parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {  // a help, or the version
      app_->exit(error);
      return;
    }
    // the value of a mistyped option looks like an argument, which CLI11 reports instead
    if (words.command != app_.get())
      if (const std::string wrong = unknown_option(*words.command, words.own); !wrong.empty()) throw UsageError(wrong);
    const std::vector<std::string> left = words.command->remaining();
    const bool too_many = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr && !left.empty();
    std::string wrong = too_many ? argument_too_many(*words.command, left.front(), words.own) : error.what();
    if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr && words.command != app_.get())
      wrong = words.command->get_name() + ": " + wrong;
    throw UsageError(std::move(wrong), "Run with --help for more information.\n");
  }
}

}  // namespace jarol::tools

// The command line: subcommands and their options. Only command_line.cpp includes the header of CLI11, which takes
// longer to compile than anything a command does.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace jarol::tools {

/// An option or an argument, as man pages and completion show it.
struct OptionText {
  std::string names;  // "-o,--out", or of an argument "FILE"
  std::string text;
  bool is_argument = false;
  bool is_required = false;
  bool takes_value = false;  // else it is a flag
  bool repeats = false;
  std::vector<std::string> words;       // of its value: all there are, or some
  bool is_file = false;                 // its value is one
  std::vector<std::string> extensions;  // that such a file has; none: any
  bool is_folder = false;
};

/// A subcommand, likewise.
struct CommandText {
  std::string name;
  std::string text;
  std::string footer;
  std::vector<OptionText> options;  // in the order of --help
};

/// What may be said about an option once it is added.
class Option {
 public:
  explicit Option(CLI::Option& option) : option_(option) {}
  Option* required();
  /// Each use takes one value: the word after it is an argument again.
  Option* one_value();
  Option* in_range(int min, int max);
  Option* in_range(double min, double max);
  Option* one_of(const std::vector<std::string>& words);
  Option* excludes(const Option* other);
  /// For completion alone: words that make sense, beside others.
  Option* suggests(const std::vector<std::string>& words);
  /// For completion alone: the name of a file, which ends with one of these if any are given.
  Option* file(const std::vector<std::string>& extensions = {});
  /// For completion alone: the name of a folder.
  Option* folder();
  OptionText describe() const;

 private:
  CLI::Option& option_;
  std::vector<std::string> words_, extensions_;
  bool is_file_ = false, is_folder_ = false;
};

/// A subcommand.
class Command {
 public:
  explicit Command(CLI::App& app) : app_(app) {}
  /// An option, or an argument if its name is no dash: its value is a std::string, a std::vector<std::string>, an int,
  /// a std::uint64_t or a double, which must be there when the command line is parsed.
  template <class T>
  Option* add_option(const std::string& name, T& value, const std::string& text);
  /// An option whose word is taken by a function.
  Option* add_option(const std::string& name, const std::function<void(const std::string&)>& take,
                     const std::string& text);
  Option* add_flag(const std::string& name, bool& value, const std::string& text);
  Option* add_flag(const std::string& name, const std::function<void()>& take, const std::string& text);
  /// A flag that may have a value in the same word, as in --console=8080, and without one has "true"; the word after it
  /// is an argument again. `value_name` is what --help calls the value.
  Option* add_flag_with_value(const std::string& name, std::string& value, const std::string& value_name,
                              const std::string& text);
  /// Was the option of that name among the words?
  bool given(const std::string& name) const;
  /// Throws InputError for the first of these options that was given: its name and this text, as in
  /// "--csv belongs to --script". For options that would have no effect.
  void refuse(const std::vector<std::string>& names, const std::string& why) const;
  void footer(const std::string& text);
  /// What the command does, once all its words are understood.
  void callback(const std::function<void()>& action);
  CommandText describe() const;

 private:
  CLI::App& app_;
  std::deque<Option> options_;
};

class CommandLine {
 public:
  CommandLine(const std::string& name, const std::string& text, const std::string& version);
  ~CommandLine();
  CommandLine(CommandLine&&) noexcept;
  Command* add_subcommand(const std::string& name, const std::string& text);
  std::vector<std::string> names() const;
  /// What --help prints.
  std::string help() const;
  /// What it is, above the commands of --help.
  std::string text() const;
  std::vector<CommandText> describe() const;
  /// Does what the words say, or prints the help asked for. Throws UsageError if they are not understood.
  void parse(int argc, char** argv);
  /// Is --json among the words, as an option of the command? Also where others of them are not understood.
  bool asks_for_json(int argc, char** argv) const;

 private:
  struct Words;
  Words split(int argc, char** argv) const;

  std::unique_ptr<CLI::App> app_;
  std::deque<Command> commands_;
};

}  // namespace jarol::tools

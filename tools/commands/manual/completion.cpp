#include "tools/commands/manual/completion.h"

namespace jarol::tools {
namespace {

// What does the work; it stands behind the tables.
constexpr const char* script = R"bash(
# _jarol_offer KIND WORD...: what begins with $current: of these words, files that end with them, or folders
_jarol_offer() {
  local kind=$1 extension
  shift
  case $kind in
    words) mapfile -t COMPREPLY < <(compgen -W "$*" -- "$current") ;;
    folder) mapfile -t COMPREPLY < <(compgen -d -- "$current") ;;
    files)
      if [ $# -eq 0 ]; then
        mapfile -t COMPREPLY < <(compgen -f -- "$current")
      else
        mapfile -t COMPREPLY < <(
          compgen -d -- "$current"
          for extension in "$@"; do compgen -f -X "!*.$extension" -- "$current"; done
        )
      fi
      ;;
  esac
  if [ "$kind" != words ]; then compopt -o filenames 2>/dev/null; fi
  return 0
}

_jarol() {
  local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]} word
  local -i at argument=0
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    _jarol_offer words "$_jarol_commands --help --version"
    return
  fi
  if [ "$command" = help ]; then
    if [ "$COMP_CWORD" -eq 2 ]; then _jarol_offer words "$_jarol_commands"; fi
    return
  fi
  # as in --clock=re, which bash takes for three words
  if [ "$current" = = ]; then
    current=
  elif [ "$before" = = ]; then
    before=${COMP_WORDS[COMP_CWORD - 2]}
  fi
  if [[ $before == -* ]] && _jarol_value "$command" "$before"; then return; fi
  if [[ $current == -* ]]; then
    _jarol_options "$command"
    return
  fi
  # which of the arguments it is
  for ((at = 2; at < COMP_CWORD; ++at)); do
    word=${COMP_WORDS[at]}
    if [[ $word != -* ]]; then
      argument+=1
    elif [ "${COMP_WORDS[at + 1]}" = = ]; then
      at+=2
    elif _jarol_value "$command" "$word"; then
      at+=1
    fi
  done
  COMPREPLY=()
  _jarol_argument "$command" "$argument"
}

complete -F _jarol jarol
)bash";

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += " " + word;
  return text;
}

// The names of an option, as in "-o,--out".
std::vector<std::string> names_of(const OptionText& option) {
  std::vector<std::string> names{""};
  for (const char c : option.names) {
    if (c == ',')
      names.emplace_back();
    else
      names.back() += c;
  }
  return names;
}

// What is offered for a value; empty: nothing is known of it.
std::string offer(const OptionText& option) {
  if (option.is_folder) return "_jarol_offer folder";
  if (option.is_file) return "_jarol_offer files" + joined(option.extensions);
  return option.words.empty() ? "" : "_jarol_offer words" + joined(option.words);
}

std::string options_function(const std::vector<CommandText>& commands) {
  std::string text = "_jarol_options() {\n  case $1 in\n";
  for (const CommandText& command : commands) {
    text += "    " + command.name + ") _jarol_offer words";
    for (const OptionText& option : command.options)
      if (!option.is_argument) text += joined(names_of(option));
    text += " ;;\n";
  }
  return text + "  esac\n}\n";
}

// True for an option that takes a value.
std::string value_function(const std::vector<CommandText>& commands) {
  std::string text = "_jarol_value() {\n  case \"$1 $2\" in\n";
  for (const CommandText& command : commands)
    for (const OptionText& option : command.options) {
      if (option.is_argument || !option.takes_value) continue;
      std::string patterns;
      for (const std::string& name : names_of(option))
        patterns += (patterns.empty() ? "" : " | ") + std::string("\"") + command.name + " " + name + "\"";
      const std::string offered = offer(option);
      text += "    " + patterns + ") " + (offered.empty() ? ":" : offered) + " ;;\n";
    }
  return text + "    *) return 1 ;;\n  esac\n}\n";
}

std::string argument_function(const std::vector<CommandText>& commands) {
  std::string text = "_jarol_argument() {\n  case \"$1 $2\" in\n";
  for (const CommandText& command : commands) {
    int index = 0;
    for (const OptionText& option : command.options) {
      if (!option.is_argument) continue;
      const std::string at = option.repeats ? "*" : std::to_string(index);
      if (const std::string offered = offer(option); !offered.empty())
        text += "    \"" + command.name + " \"" + at + ") " + offered + " ;;\n";
      ++index;
    }
  }
  return text + "  esac\n}\n";
}

}  // namespace

std::string bash_completion(const std::vector<CommandText>& commands) {
  std::string names = "help";
  for (const CommandText& command : commands) names += " " + command.name;
  return "# bash completion of jarol, made by the build of its tables of options\n_jarol_commands='" + names + "'\n\n" +
         options_function(commands) + "\n# of the value of an option; an error if it has none\n" +
         value_function(commands) + "\n" + argument_function(commands) + script;
}

}  // namespace jarol::tools

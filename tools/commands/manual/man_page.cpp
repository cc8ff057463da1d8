#include "tools/commands/manual/man_page.h"

#include <sstream>

namespace jarol::tools {
namespace {

// As groff prints it: no escapes, no requests, hyphens that can be copied.
std::string escaped(const std::string& text) {
  std::string made;
  bool at_begin = true;
  for (const char c : text) {
    if (at_begin && (c == '.' || c == '\'')) made += "\\&";
    if (c == '\\')
      made += "\\e";
    else if (c == '-')
      made += "\\-";
    else
      made += c;
    at_begin = c == '\n';
  }
  return made;
}

std::string header(const std::string& name, const std::string& version) {
  std::string title = name;
  for (char& c : title)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return ".\\\" Made by the build, of the tables that --help prints.\n.TH " + escaped(title) + " 1 \"\" \"jarol " +
         escaped(version) + "\" \"Jarol\"\n";
}

// Lines as they stand: tables among them keep their form.
std::string as_it_stands(const std::string& text) { return ".nf\n" + escaped(text) + "\n.fi\n"; }

// Up to where it begins to go into detail.
std::string first_line(const std::string& text) {
  const std::string line = text.substr(0, text.find('\n'));
  return line.substr(0, line.find_first_of(":;"));
}

std::string word_of(const OptionText& option) {
  std::string names = "\\fB" + escaped(option.names) + "\\fR";
  if (option.takes_value && !option.is_argument) {
    names += option.is_file ? " \\fIFILE\\fR" : option.is_folder ? " \\fIDIR\\fR" : " \\fIVALUE\\fR";
    if (option.repeats) names += " ...";
  }
  return names;
}

std::string synopsis(const CommandText& command) {
  std::string text = "\\fBjarol " + escaped(command.name) + "\\fR [\\fIOPTIONS\\fR]";
  for (const OptionText& option : command.options) {
    if (!option.is_argument) continue;
    const std::string name = "\\fI" + escaped(option.names) + "\\fR" + (option.repeats ? " ..." : "");
    text += option.is_required ? " " + name : " [" + name + "]";
  }
  return text + "\n";
}

void add_options(std::ostringstream& page, const CommandText& command, bool arguments) {
  bool any = false;
  for (const OptionText& option : command.options) {
    if (option.is_argument != arguments) continue;
    if (!any) page << ".SH " << (arguments ? "ARGUMENTS" : "OPTIONS") << "\n";
    any = true;
    page << ".TP\n" << word_of(option) << "\n" << escaped(option.text) << "\n";
  }
}

}  // namespace

std::string man_page(const std::string& text, const std::vector<CommandText>& commands, const std::string& version) {
  std::ostringstream page;
  page << header("jarol", version) << ".SH NAME\njarol \\- runs control programs that are graphs of isolated tasks\n"
       << ".SH SYNOPSIS\n\\fBjarol\\fR \\fICOMMAND\\fR [\\fIOPTIONS\\fR] ...\n"
       << ".SH DESCRIPTION\n"
       << as_it_stands(text) << ".SH COMMANDS\n";
  for (const CommandText& command : commands)
    page << ".TP\n\\fBjarol\\-" << escaped(command.name) << "\\fR(1)\n" << escaped(first_line(command.text)) << "\n";
  page << ".SH OPTIONS\n.TP\n\\fB\\-h,\\-\\-help\\fR\nPrint what there is, behind a command all about that\n"
       << ".TP\n\\fB\\-V,\\-\\-version\\fR\nPrint version, compiler and libraries\n";
  page << ".SH EXIT STATUS\n0 good; 1 a negative verdict; 2 bad input; 3 not brought to an end; 129, 130 or 143 ended "
          "by "
          "a signal.\n";
  return page.str();
}

std::string man_page(const CommandText& command, const std::string& version) {
  std::ostringstream page;
  page << header("jarol-" + command.name, version) << ".SH NAME\njarol\\-" << escaped(command.name) << " \\- "
       << escaped(first_line(command.text)) << "\n.SH SYNOPSIS\n"
       << synopsis(command) << ".SH DESCRIPTION\n"
       << as_it_stands(command.text);
  add_options(page, command, true);
  add_options(page, command, false);
  if (!command.footer.empty()) page << ".SH NOTES\n" << as_it_stands(command.footer);
  page << ".SH SEE ALSO\n\\fBjarol\\fR(1)\n";
  return page.str();
}

}  // namespace jarol::tools

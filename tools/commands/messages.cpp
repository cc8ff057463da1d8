// jarol messages: message sets, their messages and fields; packets to JSON and back.
#include <algorithm>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "distributers/messages/message_set.h"
#include "graph/language/problems.h"
#include "graph/text/errors.h"
#include "tools/commands/commands.h"
#include "tools/commands/run/known_with.h"
#include "tools/commands/run/packet_lines.h"
#include "tools/report/command_line.h"
#include "tools/report/json_line.h"

namespace jarol::tools {
namespace {

using messages::FieldDescriptor;
using messages::MessageDescriptor;
using messages::MessageSet;
using Json = nlohmann::ordered_json;
using Rows = std::vector<std::vector<std::string>>;

struct MessagesOptions {
  std::string set, name;
  std::vector<std::string> plugins;
  bool json = false, decode = false, encode = false;
};

// Cells under one another, the last one open to the right.
void print_rows(const Rows& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i == widths.size()) widths.push_back(0);
      widths[i] = std::max(widths[i], row[i].size());
    }
  for (const auto& row : rows) {
    std::string line = " ";
    for (std::size_t i = 0; i < row.size(); ++i) line += " " + row[i] + std::string(widths[i] - row[i].size() + 1, ' ');
    line.erase(line.find_last_not_of(' ') + 1);
    std::cout << line << "\n";
  }
}

std::string size_text(const MessageDescriptor& m) {
  return m.wire_size < 0 ? "any size" : std::to_string(m.wire_size) + (m.wire_size == 1 ? " byte" : " bytes");
}

std::string type_text(const FieldDescriptor& f) {
  std::string text(f.type);
  if (f.count > 0) text += "[" + std::to_string(f.count) + "]";
  if (!f.message_type.empty()) text += " of " + std::string(f.message_type);
  if (!f.unit.empty()) text += " [" + std::string(f.unit) + "]";
  return text;
}

std::string notes_on(const FieldDescriptor& f) {
  std::string text(f.text);
  const auto add = [&](const std::string& note) { text += (text.empty() ? "" : ", ") + note; };
  if (!f.min.empty() || !f.max.empty()) add((f.min.empty() ? "" : std::string(f.min)) + " to " + std::string(f.max));
  if (!f.standard.empty()) add("default " + std::string(f.standard));
  return text;
}

void print_sets(const std::vector<const MessageSet*>& sets) {
  Rows rows;
  for (const MessageSet* set : sets)
    rows.push_back({std::string(set->name), std::to_string(set->messages.size()) + " messages",
                    std::string(set->title) + " " + std::string(set->version) + ": " + std::string(set->text)});
  print_rows(rows);
  std::cout << "\njarol messages SET lists its messages, jarol messages SET NAME the fields of one\n";
}

void print_set(const MessageSet& set) {
  std::cout << set.name << ": " << set.text << ", " << set.title << " " << set.version << "\n\n";
  Rows rows;
  for (const MessageDescriptor* m : set.messages)
    rows.push_back({std::to_string(m->id), std::string(m->name), size_text(*m), std::string(m->text)});
  print_rows(rows);
}

void print_message(const MessageDescriptor& m) {
  std::cout << m.name << ", id " << m.id << ", " << size_text(m) << ": " << m.text << "\n";
  Rows rows;
  for (const FieldDescriptor& f : m.fields) {
    rows.push_back({std::string(f.name), type_text(f), notes_on(f)});
    for (const auto& v : f.values) rows.push_back({"", "", std::to_string(v.value) + " " + std::string(v.name)});
  }
  if (!rows.empty()) std::cout << "\n";
  print_rows(rows);
}

Json json_of(const FieldDescriptor& f) {
  Json json{{"name", f.name}, {"type", f.type}, {"unit", f.unit}, {"text", f.text}};
  if (f.count > 0) json["count"] = f.count;
  if (!f.min.empty()) json["min"] = f.min;
  if (!f.max.empty()) json["max"] = f.max;
  if (!f.standard.empty()) json["default"] = f.standard;
  if (!f.message_type.empty()) json["message_type"] = f.message_type;
  for (const auto& v : f.values) json[f.bits ? "bits" : "values"][std::string(v.name)] = v.value;
  return json;
}

void print_json(const std::vector<const MessageDescriptor*>& listed) {
  Json whole{{"schema", "jarol.messages/2"}, {"messages", Json::array()}};
  for (const MessageDescriptor* m : listed) {
    Json fields = Json::array();
    for (const FieldDescriptor& f : m->fields) fields.push_back(json_of(f));
    whole["messages"].push_back({{"set", m->set().name},
                                 {"name", m->name},
                                 {"id", m->id},
                                 {"text", m->text},
                                 {"bytes", m->wire_size < 0 ? Json() : Json(m->wire_size)},
                                 {"fields", fields}});
  }
  std::cout << json_line(whole);
}

int list_messages(const MessagesOptions& options) {
  const std::vector<const MessageSet*> sets = sets_of(known_with(options.plugins));
  std::vector<std::string> names;
  std::vector<const MessageDescriptor*> listed;
  if (options.set.empty()) {
    if (options.decode || options.encode)
      throw InputError("--decode and --encode need a set; jarol messages lists them");
    for (const MessageSet* set : sets) listed.insert(listed.end(), set->messages.begin(), set->messages.end());
    options.json ? print_json(listed) : print_sets(sets);
    return exit_good;
  }
  const auto found =
      std::find_if(sets.begin(), sets.end(), [&](const MessageSet* each) { return each->name == options.set; });
  const MessageSet* const set = found == sets.end() ? nullptr : *found;
  if (set == nullptr) {
    for (const MessageSet* known : sets) names.emplace_back(known->name);
    throw InputError("there is no message set '" + options.set + "'" + did_you_mean(options.set, names) +
                     "; there are: " + list_of(names));
  }
  if (options.decode) return decode_lines(*set, std::cin, std::cout, std::cerr);
  if (options.encode) return encode_lines(*set, std::cin, std::cout, std::cerr);
  if (options.name.empty()) {
    listed.assign(set->messages.begin(), set->messages.end());
    options.json ? print_json(listed) : print_set(*set);
    return exit_good;
  }
  const MessageDescriptor* const descriptor = set->find(std::string_view(options.name));
  if (descriptor == nullptr) {
    for (const MessageDescriptor* m : set->messages) names.emplace_back(m->name);
    const std::string close = did_you_mean(options.name, names);
    throw InputError("set " + options.set + " has no message '" + options.name + "'" +
                     (close.empty() ? "; jarol messages " + options.set + " lists them" : close));
  }
  options.json ? print_json({descriptor}) : print_message(*descriptor);
  return exit_good;
}

}  // namespace

void add_messages(CommandLine& line, int& exit_code) {
  auto options = std::make_shared<MessagesOptions>();
  Command* command =
      line.add_subcommand("messages", "List message sets, their messages and fields, or turn packets to JSON and back");
  command->add_option("SET", options->set, "A message set, as in imc");
  auto* name = command->add_option("NAME", options->name, "A message of it, as in EstimatedState");
  command->add_option("--plugin", options->plugins, "Also those of this shared library")->file({"so"})->one_value();
  auto* json = command->add_flag("--json", options->json, "One JSON object instead of text");
  auto* decode = command->add_flag("--decode", options->decode,
                                   "Packets from stdin, one of hexadecimal digits a line, to JSON objects, one a line");
  auto* encode = command->add_flag("--encode", options->encode, "JSON objects of that form from stdin to packets");
  for (Option* one : {decode, encode})
    for (Option* other : {name, json}) one->excludes(other);
  decode->excludes(encode);
  command->footer(
      "--decode and --encode go on after a line that is wrong, and exit with 2 then, or with 1 if only checksums were "
      "wrong.");
  command->callback([options, &exit_code] { exit_code = list_messages(*options); });
}

}  // namespace jarol::tools

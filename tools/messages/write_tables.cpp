#include <algorithm>

#include "tools/messages/write.h"

namespace jarol::definition {
namespace {

std::string wire_of(const Field& field) {
  if (field.type == "message-list") return "message_list";
  return field.type.ends_with("_t") ? field.type.substr(0, field.type.size() - 2) : field.type;
}

class TableWriter {
 public:
  explicit TableWriter(const Definition& definition) : definition_(definition), names_(definition) {}

  std::string write(const std::string& set) {
    to_ = "// Made from the definition of message set " + set + ".\n#include \"distributers/messages/" + set +
          ".h\"\n\nnamespace jarol::messages::" + set + " {\nnamespace {\n\n";
    for (const Values& v : definition_.shared)
      if (is_used(v.name)) write_values("shared_" + names_.shared.at(v.name), v.values);
    write_fields(definition_.header, "Header", "header_fields");
    for (std::size_t i = 0; i < definition_.messages.size(); ++i)
      write_fields(definition_.messages[i], definition_.messages[i].name, "fields_" + std::to_string(i));
    to_ += "constexpr const MessageDescriptor* forms[] = {";
    for (const Message& m : definition_.messages) to_ += "&" + names_.structs.at(m.name) + "::descriptor, ";
    to_ += "};\n\n";
    write_set(set);
    to_ += "}  // namespace\n\nconst MessageSet& message_set() { return set; }\n\n";
    write_descriptor(definition_.header, 0, "Header", "header_fields");
    for (std::size_t i = 0; i < definition_.messages.size(); ++i)
      write_descriptor(definition_.messages[i], i, definition_.messages[i].name, "fields_" + std::to_string(i));
    to_ += "\n}  // namespace jarol::messages::" + set + "\n";
    return to_;
  }

 private:
  bool is_used(const std::string& shared) const {
    const auto refers = [&](const Message& m) {
      return std::ranges::any_of(m.fields, [&](const Field& f) { return f.shared_values == shared; });
    };
    return refers(definition_.header) || std::ranges::any_of(definition_.messages, refers);
  }

  void write_descriptor(const Message& message, std::size_t index, const std::string& key, const std::string& table) {
    const std::string& name = names_.structs.at(key);
    to_ += "constinit const MessageDescriptor " + name + "::descriptor = descriptor_of<" + name + ">(" +
           quoted(message.name) + ", " + std::to_string(message.id) + "U, " + std::to_string(index) + ", " +
           quoted(message.text) + ", " + std::to_string(message.wire_size) + ", " +
           (message.fields.empty() ? "{}" : table) + ", &message_set);\n";
  }

  void write_values(const std::string& name, const std::vector<NamedValue>& values) {
    to_ += "constexpr NamedValue " + name + "[] = {";
    for (const NamedValue& v : values) to_ += "{" + quoted(v.name) + ", " + std::to_string(v.value) + "}, ";
    to_ += "};\n";
  }

  void write_fields(const Message& message, const std::string& key, const std::string& table) {
    std::string rows;
    add_rows(message, key, "", table, rows);
    if (!rows.empty()) to_ += "constexpr FieldDescriptor " + table + "[] = {\n" + rows + "};\n";
  }

  // One row a field; `base` is the offset of the part that the message is, as C++.
  void add_rows(const Message& message, const std::string& key, const std::string& base, const std::string& table,
                std::string& rows) {
    for (const Field& f : message.fields) {
      const std::string offset =
          base + "offsetof(" + names_.structs.at(key) + ", " + names_.members.at(key).at(f.name) + ")";
      if (f.type == "part") {
        for (const Message& m : definition_.messages)
          if (m.name == f.message_type) add_rows(m, m.name, offset + " + ", table, rows);
        continue;
      }
      const std::string own = table + "_" + std::to_string(extras_++);
      std::string row = "    {.name = " + quoted(f.name) + ", .wire = Wire::" + wire_of(f) + ", .offset = " + offset;
      if (f.count > 0) row += ", .count = " + std::to_string(f.count);
      if (f.unit == "Digits") row += ", .digits = true";
      const auto add = [&](const char* name, const std::string& text) {
        if (!text.empty()) row += std::string(", .") + name + " = " + quoted(text);
      };
      add("type", f.type);
      add("unit", f.unit);
      add("text", f.text);
      add("min", f.min);
      add("max", f.max);
      add("standard", f.standard);
      if (f.bits) row += ", .bits = true";
      if (!f.values.empty()) {
        if (f.shared_values.empty()) write_values(own, f.values);
        row += ", .values = " + (f.shared_values.empty() ? own : "shared_" + names_.shared.at(f.shared_values));
      }
      add("message_type", f.message_type);
      if (!f.ids.empty()) {
        to_ += "constexpr ::std::uint32_t " + own + "_ids[] = {";
        for (const std::uint32_t id : f.ids) to_ += std::to_string(id) + "U, ";
        to_ += "};\n";
        row += ", .ids = " + own + "_ids";
      }
      rows += row + "},\n";
    }
  }

  void write_set(const std::string& set) {
    const Definition& d = definition_;
    const auto line = [&](const std::string& name, const std::string& value) {
      to_ += "    ." + name + " = " + value + ",\n";
    };
    to_ += "constexpr MessageSet set = {\n";
    line("name", quoted(set));
    line("title", quoted(d.title));
    line("version", quoted(d.version));
    line("text", quoted(d.text));
    line("header", "&Header::descriptor");
    line("id_field", std::to_string(d.id_field));
    line("size_field", std::to_string(d.size_field));
    line("sync", d.header.fields[0].standard);
    line("order", "ByteOrder::" + std::string(d.order == "big" ? "big" : "little"));
    line("either_order", d.order == "either" ? "true" : "false");
    line("checksum", "Checksum::" + (d.checksum_name.empty() ? "none" : d.checksum));
    line("checksum_from", std::to_string(d.checksum_from));
    line("checksum_name", quoted(d.checksum_name));
    line("max_payload", std::to_string(d.max_payload));
    line("messages", "forms");
    to_ += "};\n\n";
  }

  const Definition& definition_;
  const Names names_;
  std::size_t extras_ = 0;  // counts tables beside those of fields
  std::string to_;
};

}  // namespace

std::string write_tables(const Definition& definition, const std::string& set) {
  return TableWriter(definition).write(set);
}

std::string write_catalogue(const std::vector<std::string>& sets) {
  std::string to =
      "// Made from the list of message sets.\n#include \"distributers/messages/message_set.h\"\n\nnamespace "
      "jarol::messages {\n\n";
  std::string list;
  for (const std::string& set : sets) {
    to += "namespace " + set + " {\nconst MessageSet& message_set();\n}\n";
    list += (list.empty() ? "" : ", ") + std::string("&") + set + "::message_set()";
  }
  return to + "\nstd::span<const MessageSet* const> message_sets() {\n  static const MessageSet* const sets[] = {" +
         list + "};\n  return sets;\n}\n\n}  // namespace jarol::messages\n";
}

}  // namespace jarol::definition

#include <algorithm>
#include <charconv>
#include <cmath>

#include "tools/messages/write.h"

namespace jarol::definition {
namespace {

std::string element_type(const Field& field, const Names& names) {
  if (field.type == "fp32_t") return "float";
  if (field.type == "fp64_t") return "double";
  if (field.type == "plaintext") return "::jarol::String";
  if (field.type == "rawdata" || field.type == "rest") return "::jarol::Sequence<::std::uint8_t>";
  if (field.type == "message") return "::jarol::messages::InlineMessage";
  if (field.type == "message-list") return "::jarol::Sequence<::jarol::messages::InlineMessage>";
  if (field.type == "part") return names.structs.at(field.message_type);
  return "::std::" + field.type;
}

std::string member_type(const Field& field, const Names& names) {
  const std::string element = element_type(field, names);
  return field.count == 0 ? element : "::std::array<" + element + ", " + std::to_string(field.count) + ">";
}

// The default as C++, or an empty text if it is none: a number within the type, or the name of a value.
std::string initial(const Field& field) {
  const std::string& text = field.standard;
  if (text.empty()) return "{}";
  if (field.type == "plaintext") return "{" + quoted(text) + "}";
  for (const NamedValue& v : field.values)
    if (v.name == text) return "{" + std::to_string(v.value) + "}";
  const char *const begin = text.data(), *const end = begin + text.size();
  if (field.type == "fp32_t" || field.type == "fp64_t") {
    double value = 0;
    const auto [stop, error] = std::from_chars(begin, end, value);
    if (error != std::errc() || stop != end) return "";
    const std::string type = field.type == "fp32_t" ? "float" : "double";
    const std::string sign = std::signbit(value) ? "-" : "";
    if (std::isnan(value)) return "{::std::numeric_limits<" + type + ">::quiet_NaN()}";
    if (std::isinf(value)) return "{" + sign + "::std::numeric_limits<" + type + ">::infinity()}";
    return "{static_cast<" + type + ">(" + text + ")}";
  }
  if (size_of(field.type) == 0 || field.count > 0) return "";
  const auto integer = parse_integer(text);
  if (!integer || !fits(*integer, field.type)) return "";
  if (!integer->negative) return "{" + std::to_string(integer->magnitude) + (field.type[0] == 'u' ? "U}" : "}");
  if (integer->magnitude >> 63 != 0) return "{::std::numeric_limits<::std::int64_t>::min()}";  // has no literal
  return "{-" + std::to_string(integer->magnitude) + "}";
}

// What a default may be.
std::string default_text(const Field& field) {
  if (size_of(field.type) == 0 || field.count > 0) return "none, which only texts and single numbers have";
  std::vector<std::string> names;
  for (const NamedValue& v : field.values) names.push_back(v.name);
  const std::string number = field.type[0] == 'f' ? "a number" : "an integer that fits " + field.type;
  return number + (names.empty() ? "" : ", or one of: " + list_of(names));
}

// `type` is that of the field, where there is one: constants are of it if all values fit
void write_values(const std::string& name, const std::vector<NamedValue>& values, const std::string& indent,
                  std::string& to, const std::string& type = "int64_t") {
  const bool fit = std::all_of(values.begin(), values.end(), [&](const NamedValue& v) {
    return fits(*parse_integer(std::to_string(v.value)), type);
  });
  to += indent + "struct " + name + " {\n";
  const std::vector<std::string> names = value_names(values);
  for (std::size_t i = 0; i < values.size(); ++i)
    to += indent + "  static constexpr ::std::" + (fit ? type : "int64_t") + " " + names[i] + " = " +
          std::to_string(values[i].value) + ";\n";
  to += indent + "};\n";
}

class HeaderWriter {
 public:
  explicit HeaderWriter(const Definition& definition) : definition_(definition), names_(definition) {}

  std::string write(const std::string& set) {
    to_ = "// Made from the definition of message set " + set +
          ": a change there is a change here.\n"
          "#pragma once\n\n"
          "#include <array>\n#include <cstdint>\n#include <limits>\n\n"
          "#include \"distributers/messages/inline_message.h\"\n"
          "#include \"distributers/messages/message_set.h\"\n\n"
          "namespace jarol::messages::" +
          set + " {\n\nconst MessageSet& message_set();\n";
    for (const Values& v : definition_.shared) {
      to_ += "\n";
      write_values(names_.shared.at(v.name), v.values, "", to_);
    }
    write_struct(definition_.header, "Header");
    for (const Message& m : definition_.messages) write_with_parts(m);
    to_ += "\n}  // namespace jarol::messages::" + set + "\n";
    problems_.throw_if_any();
    return to_;
  }

 private:
  // parts come before what they are part of
  void write_with_parts(const Message& message) {
    if (std::find(written_.begin(), written_.end(), message.name) != written_.end()) return;
    written_.push_back(message.name);
    for (const Field& f : message.fields)
      for (const Message& m : definition_.messages)
        if (f.type == "part" && m.name == f.message_type) write_with_parts(m);
    write_struct(message, message.name);
  }

  void write_struct(const Message& message, const std::string& key) {
    const std::string& name = names_.structs.at(key);
    to_ += "\n";
    if (!message.text.empty()) to_ += "/// " + message.text + (message.text.ends_with('\\') ? "." : "") + "\n";
    to_ += "struct " + name + " {\n";
    if (key != "Header") to_ += "  static constexpr ::std::uint32_t message_id = " + std::to_string(message.id) + ";\n";
    for (const Field& f : message.fields)
      if (!f.values.empty() && f.shared_values.empty())
        write_values(names_.own_values.at(key).at(f.name), f.values, "  ", to_, f.type);
    std::string described;
    for (const Field& f : message.fields) {
      const std::string& member = names_.members.at(key).at(f.name);
      const std::string value = f.type == "part" ? "{}" : initial(f);
      if (value.empty())
        problems_.add(f.where, "message '" + message.name + "' field '" + f.name + "' of type " + f.type +
                                   " has the default '" + f.standard + "'; it needs " + default_text(f));
      to_ += "  " + member_type(f, names_) + " " + member + value + ";\n";
      described += (described.empty() ? "" : ",\n        ") + std::string("::jarol::field<&Described::") + member +
                   ">(" + quoted(f.unit == "Enumerated" || f.unit == "Bitfield" ? "" : f.unit) + ", " + quoted(f.text) +
                   ")";
    }
    // a template, so that only who uses the description pays for it
    to_ += "  template <class Described = " + name +
           ">\n  static constexpr auto fields() {\n    return ::jarol::describe(" + described +
           ");\n  }\n  static const ::jarol::messages::MessageDescriptor descriptor;\n};\n";
  }

  const Definition& definition_;
  const Names names_;
  std::vector<std::string> written_;
  std::string to_;
  Problems problems_;
};

}  // namespace

std::string write_header(const Definition& definition, const std::string& set) {
  return HeaderWriter(definition).write(set);
}

}  // namespace jarol::definition

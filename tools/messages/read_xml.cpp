#include <algorithm>
#include <pugixml.hpp>

#include "tools/messages/definition.h"

namespace jarol::definition {
namespace {

// " as it  stands\n over lines" as one line without ends
std::string one_line(const char* text) {
  std::string line;
  for (const char* c = text; *c != 0; ++c) {
    const bool space = *c == ' ' || *c == '\n' || *c == '\t' || *c == '\r';
    if (!space) line += *c;
    if (space && !line.empty() && line.back() != ' ') line += ' ';
  }
  if (!line.empty() && line.back() == ' ') line.pop_back();
  return line;
}

class XmlReader {
 public:
  XmlReader(std::shared_ptr<const Source> source, Problems& problems)
      : source_(std::move(source)), problems_(problems) {
    for (std::size_t at = 0; (at = source_->text.find('\n', at)) != std::string::npos;) lines_.push_back(++at);
  }

  Definition read() {
    Definition definition;
    constexpr std::ptrdiff_t max_marks = 500'000;  // elements, their ends and attributes
    const std::string& text = source_->text;
    if (std::count_if(text.begin(), text.end(), [](char c) { return c == '<' || c == '='; }) > max_marks) {
      problems_.add({source_, 1, 1}, "the XML has more than " + std::to_string(max_marks) +
                                         " elements and attributes; a definition has a few thousand");
      return definition;
    }
    pugi::xml_document document;
    const pugi::xml_parse_result result = document.load_buffer(source_->text.data(), source_->text.size());
    if (!result) {
      std::string what = result.description();
      what[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(what[0])));
      problems_.add(place(result.offset),
                    "the XML can't be read: " + what + "; a definition is one element <messages>");
      return definition;
    }
    const pugi::xml_node root = document.document_element();
    definition.where = place(root);
    if (std::string_view(root.name()) != "messages") {
      problems_.add(place(root),
                    "the definition is an element <" + std::string(root.name()) + ">; it needs <messages>");
      return definition;
    }
    check_attributes(root,
                     {"name", "long-name", "version", "creation", "revision", "byte-order", "checksum", "checksum-from",
                      "most-bytes"},
                     "the definition");
    check_children(root,
                   {"description", "types", "serialization", "units", "enumerations", "bitfields", "message-groups",
                    "flags", "header", "footer", "groups", "categories", "message"},
                   "the definition");
    definition.title = needed(root, "name", "the definition");
    definition.version = root.attribute("version").value();
    definition.text = root.attribute("long-name").value();
    definition.order =
        one_of(root, "byte-order", {"either", "little", "big", "LITTLE_ENDIAN", "BIG_ENDIAN"}, "the definition");
    // as the schema of the public definition spells them
    if (definition.order == "LITTLE_ENDIAN") definition.order = "little";
    if (definition.order == "BIG_ENDIAN") definition.order = "big";
    definition.checksum = one_of(root, "checksum", {"crc16_ibm", "sum16"}, "the definition");
    definition.checksum_from = static_cast<std::size_t>(integer(root, "checksum-from", 0, 0xffff, 0, "the definition"));
    definition.max_payload = static_cast<std::size_t>(integer(root, "most-bytes", 1, 0xffff, 0xffff, "the definition"));
    for (const pugi::xml_node list : root.children("enumerations")) read_shared(list, false, definition);
    for (const pugi::xml_node list : root.children("bitfields")) read_shared(list, true, definition);
    for (const pugi::xml_node group : root.child("message-groups").children("message-group"))
      for (const pugi::xml_node type : group.children("message-type"))
        definition.groups[needed(group, "abbrev", "a message group")].push_back(
            needed(type, "abbrev", "a message-type of a group"));
    read_frame(root, definition);
    for (const pugi::xml_node node : root.children("message"))
      definition.messages.push_back(read_message(node, definition));
    if (definition.messages.empty())
      problems_.add(place(root), "the definition has no <message>; it needs one at least");
    return definition;
  }

 private:
  Location place(std::ptrdiff_t offset) const {
    const auto at = static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0));
    const auto after = std::upper_bound(lines_.begin(), lines_.end(), at);  // behind the line's begin
    return {source_, static_cast<int>(after - lines_.begin()), static_cast<int>(at - *std::prev(after)) + 1};
  }
  // of the name after the bracket
  Location place(pugi::xml_node node) const { return place(node.offset_debug()); }

  void check_attributes(pugi::xml_node node, const std::vector<std::string>& known, const std::string& subject) {
    for (const pugi::xml_attribute attribute : node.attributes()) {
      const std::string name = attribute.name();
      if (name.find(':') != std::string::npos || name == "xmlns") continue;  // of XML itself
      if (std::find(known.begin(), known.end(), name) == known.end())
        problems_.add(place(node), subject + " has the attribute '" + name + "'" + did_you_mean(name, known) +
                                       "; it may have: " + list_of(known));
    }
  }

  void check_children(pugi::xml_node node, const std::vector<std::string>& known, const std::string& subject) {
    for (const pugi::xml_node child : node.children()) {
      const std::string name = child.name();
      if (child.type() == pugi::node_element && std::find(known.begin(), known.end(), name) == known.end())
        problems_.add(place(child), subject + " has an element <" + name + ">" + did_you_mean(name, known) +
                                        "; it may have: " + list_of(known));
    }
  }

  std::string needed(pugi::xml_node node, const char* attribute, const std::string& subject) {
    const std::string text = node.attribute(attribute).value();
    if (text.empty()) problems_.add(place(node), subject + " has no '" + attribute + "'; it needs one");
    return text;
  }

  // The attribute, or the first choice if it is not there.
  std::string one_of(pugi::xml_node node, const char* attribute, const std::vector<std::string>& choices,
                     const std::string& subject) {
    if (!node.attribute(attribute)) return choices.front();
    const std::string text = node.attribute(attribute).value();
    if (std::find(choices.begin(), choices.end(), text) == choices.end())
      problems_.add(place(node), subject + " has the " + attribute + " '" + text + "'" + did_you_mean(text, choices) +
                                     "; it may be: " + list_of(choices));
    return text;
  }

  std::int64_t integer(pugi::xml_node node, const char* attribute, std::int64_t min, std::int64_t max,
                       std::int64_t standard, const std::string& subject) {
    if (!node.attribute(attribute)) return standard;
    const std::string text = node.attribute(attribute).value();
    const auto integer = parse_integer(text);
    if (integer && fits(*integer, "int64_t")) {
      // modulo 2^64, so that the minimum comes out right
      const auto value = static_cast<std::int64_t>(integer->negative ? 0 - integer->magnitude : integer->magnitude);
      if (value >= min && value <= max) return value;
    }
    problems_.add(place(node), subject + " has the " + attribute + " '" + text + "'; it needs an integer from " +
                                   std::to_string(min) + " to " + std::to_string(max));
    return standard;
  }

  std::vector<NamedValue> read_values(pugi::xml_node node, const std::string& subject) {
    std::vector<NamedValue> values;
    for (const pugi::xml_node value : node.children("value"))
      values.push_back({needed(value, "abbrev", "a value of " + subject),
                        integer(value, "id", INT32_MIN, UINT32_MAX, 0, "a value of " + subject)});
    return values;
  }

  void read_shared(pugi::xml_node list, bool bits, Definition& definition) {
    for (const pugi::xml_node def : list.children("def")) {
      const std::string name = needed(def, "abbrev", bits ? "a bitfield" : "an enumeration");
      definition.shared.push_back({name, bits, read_values(def, "'" + name + "'")});
    }
  }

  void read_frame(pugi::xml_node root, Definition& definition) {
    const pugi::xml_node header = root.child("header");
    check_children(header, {"description", "field"}, "the header");
    check_children(root.child("footer"), {"description", "field"}, "the footer");
    definition.header.where = header ? place(header) : place(root);
    definition.header.name = definition.header.struct_name = "Header";
    definition.header.text = "What stands before every payload.";
    for (const pugi::xml_node field : header.children("field"))
      definition.header.fields.push_back(read_field(field, "the header", definition));
    std::vector<Field> footer;
    for (const pugi::xml_node field : root.child("footer").children("field"))
      footer.push_back(read_field(field, "the footer", definition));
    if (footer.size() == 1 && footer[0].type == "uint16_t") definition.checksum_name = footer[0].name;
    if (footer.size() > 1 || (footer.size() == 1 && footer[0].type != "uint16_t"))
      problems_.add(footer.back().where,
                    "the footer has more than a checksum; it needs one field of type uint16_t, or none");
  }

  Message read_message(pugi::xml_node node, const Definition& definition) {
    Message message;
    message.where = place(node);
    message.name = needed(node, "abbrev", "a message");
    const std::string subject = "message '" + message.name + "'";
    check_attributes(
        node, {"id", "name", "abbrev", "struct", "category", "source", "flags", "stable", "used-by", "deprecated"},
        subject);
    check_children(node, {"description", "field", "part"}, subject);
    message.struct_name = node.attribute("struct") ? node.attribute("struct").value() : message.name;
    needed(node, "id", subject);
    message.id = static_cast<std::uint32_t>(integer(node, "id", 0, UINT32_MAX, 0, subject));
    message.text = one_line(node.child("description").text().get());
    if (message.text.empty()) message.text = node.attribute("name").value();
    for (const pugi::xml_node child : node.children()) {
      const std::string name = child.name();
      if (name == "field") message.fields.push_back(read_field(child, subject, definition));
      if (name == "part") message.fields.push_back(read_part(child, subject));
    }
    return message;
  }

  Field read_part(pugi::xml_node node, const std::string& subject) {
    Field part;
    part.where = place(node);
    part.type = "part";
    part.name = needed(node, "abbrev", "a part of " + subject);
    check_attributes(node, {"abbrev", "message-type", "name"}, subject + " part '" + part.name + "'");
    check_children(node, {"description"}, subject + " part '" + part.name + "'");
    part.message_type = needed(node, "message-type", subject + " part '" + part.name + "'");
    part.text = one_line(node.child("description").text().get());
    if (part.text.empty()) part.text = node.attribute("name").value();
    return part;
  }

  Field read_field(pugi::xml_node node, const std::string& owner, const Definition& definition) {
    Field field;
    field.where = place(node);
    field.name = needed(node, "abbrev", "a field of " + owner);
    const std::string subject = owner + " field '" + field.name + "'";
    static const std::vector<std::string> types{"int8_t",    "uint8_t", "int16_t",  "uint16_t", "int32_t",
                                                "uint32_t",  "int64_t", "uint64_t", "fp32_t",   "fp64_t",
                                                "plaintext", "rawdata", "rest",     "message",  "message-list"};
    check_attributes(node,
                     {"name", "abbrev", "type", "unit", "min", "max", "prefix", "enum-def", "bitfield-def",
                      "message-type", "value", "note", "fixed", "count"},
                     subject);
    check_children(node, {"description", "value"}, subject);
    needed(node, "type", subject);
    field.type = one_of(node, "type", types, subject);
    field.unit = node.attribute("unit").value();
    field.text = one_line(node.child("description").text().get());
    if (field.text.empty()) field.text = node.attribute("name").value();
    field.min = node.attribute("min").value();
    field.max = node.attribute("max").value();
    field.standard = node.attribute("value").value();
    field.message_type = node.attribute("message-type").value();
    field.count = static_cast<std::uint32_t>(integer(node, "count", 1, 0xffff, 0, subject));
    field.bits = field.unit == "Bitfield";
    field.values = read_values(node, subject);
    for (const char* attribute : {"enum-def", "bitfield-def"})
      if (*node.attribute(attribute).value() != 0) read_reference(node, attribute, subject, definition, field);
    if (field.count > 0 && size_of(field.type) == 0)
      problems_.add(field.where, subject + " is an array of " + field.type + "; only numbers have a 'count'");
    if (!field.message_type.empty() && field.type != "message" && field.type != "message-list")
      problems_.add(field.where,
                    subject + " of type " + field.type + " has a message-type; only message and message-list may");
    return field;
  }

  void read_reference(pugi::xml_node node, const char* attribute, const std::string& subject,
                      const Definition& definition, Field& field) {
    const std::string wanted = node.attribute(attribute).value();
    std::vector<std::string> names;
    for (const Values& shared : definition.shared) {
      names.push_back(shared.name);
      if (shared.name != wanted) continue;
      field.values = shared.values;
      field.bits = shared.bits;
      field.shared_values = shared.name;
      return;
    }
    problems_.add(place(node), subject + " has the " + attribute + " '" + wanted + "', which is not defined" +
                                   did_you_mean(wanted, names) + "; there are: " + list_of(names));
  }

  std::vector<std::size_t> lines_{0};  // where each begins
  std::shared_ptr<const Source> source_;
  Problems& problems_;
};

}  // namespace

Definition read_xml(const std::shared_ptr<const Source>& source, Problems& problems) {
  return XmlReader(source, problems).read();
}

}  // namespace jarol::definition

#include <algorithm>
#include <set>

#include "tools/messages/definition.h"

namespace jarol::definition {
namespace {

class Resolver {
 public:
  Resolver(Definition& definition, Problems& problems) : definition_(definition), problems_(problems) {}

  void resolve() {
    check_names();
    resolve_header();
    for (const auto& [group, members] : definition_.groups)
      for (const std::string& member : members)
        if (find(member) == nullptr) report_missing(definition_.where, "message group '" + group + "'", member, false);
    for (Message& message : definition_.messages) resolve_message(message);
    if (!problems_.empty()) return;
    for (Message& message : definition_.messages) message.wire_size = size_of_message(message, {});
    std::stable_sort(definition_.messages.begin(), definition_.messages.end(), [](const Message& a, const Message& b) {
      return std::pair(a.id, a.wire_size) < std::pair(b.id, b.wire_size);
    });
    check_ids();
    if (!problems_.empty()) return;
    for (const Message& message : definition_.messages) check_field_names(message);
  }

 private:
  Message* find(const std::string& name) {
    for (Message& message : definition_.messages)
      if (message.name == name) return &message;
    return nullptr;
  }

  std::vector<std::string> names_of_messages() const {
    std::vector<std::string> names;
    for (const Message& message : definition_.messages) names.push_back(message.name);
    return names;
  }

  void report_missing(const Location& where, const std::string& subject, const std::string& name, bool or_group) {
    std::vector<std::string> names = names_of_messages();
    if (or_group)
      for (const auto& [group, members] : definition_.groups) names.push_back(group);
    problems_.add(where, subject + " names '" + name + "', which is no message" + (or_group ? " or group" : "") +
                             did_you_mean(name, names));
  }

  void check_names() {
    std::set<std::string> names;
    for (const Message& message : definition_.messages)
      if (!names.insert(message.name).second)
        problems_.add(message.where, "message '" + message.name + "' is defined twice; a name stands for one message");
    for (const auto& [group, members] : definition_.groups)
      if (names.contains(group))
        problems_.add(definition_.where,
                      "message group '" + group + "' has the name of a message; it needs one of its own");
  }

  // The header's fields have their roles by the names of the IMC definition.
  void resolve_header() {
    Message& header = definition_.header;
    const std::size_t none = header.fields.size();
    const auto field = [&](const std::string& name) {
      for (std::size_t i = 0; i < none; ++i)
        if (header.fields[i].name == name) return i;
      problems_.add(header.where, "the header has no field '" + name + "'; it needs sync (first), mgid and size");
      return none;
    };
    const std::size_t sync = field("sync"), id = field("mgid"), size = field("size");
    definition_.id_field = id;
    definition_.size_field = size;
    if (std::max({sync, id, size}) == none) return;
    if (sync != 0)
      problems_.add(header.fields[sync].where, "the header's field 'sync' is not its first; it needs to be");
    for (const std::size_t i : {sync, id, size})
      if (header.fields[i].type != "uint8_t" && header.fields[i].type != "uint16_t" &&
          header.fields[i].type != "uint32_t")
        problems_.add(header.fields[i].where, "the header's field '" + header.fields[i].name + "' is of type " +
                                                  header.fields[i].type + "; it needs uint8_t, uint16_t or uint32_t");
    std::size_t around = definition_.checksum_name.empty() ? 0 : 2;
    for (const Field& f : header.fields) {
      around += definition::size_of(f.type);
      if (definition::size_of(f.type) == 0 || f.count > 0)
        problems_.add(f.where, "the header's field '" + f.name + "' is of type " + f.type + "; it needs a number");
    }
    header.wire_size = static_cast<std::int64_t>(around - (definition_.checksum_name.empty() ? 0 : 2));
    if (definition_.checksum_from >= static_cast<std::size_t>(header.wire_size))
      problems_.add(definition_.where,
                    "the definition has the checksum-from " + std::to_string(definition_.checksum_from) +
                        "; it needs to be within the header of " + std::to_string(header.wire_size) + " bytes");
    check_sync(header.fields[sync]);
    if (definition_.max_payload <= around) {
      problems_.add(definition_.where, "the definition has the most-bytes " + std::to_string(definition_.max_payload) +
                                           "; header and checksum alone take " + std::to_string(around));
      return;
    }
    definition_.max_payload = std::min<std::size_t>(definition_.max_payload - around, largest(header.fields[size]));
  }

  static std::size_t largest(const Field& field) {
    return (std::uint64_t{1} << (8 * definition::size_of(field.type))) - 1;
  }

  void check_sync(const Field& sync) {
    if (sync.standard.empty()) {
      problems_.add(sync.where, "the header's field 'sync' has no 'value'; it needs one");
      return;
    }
    const auto integer = parse_integer(sync.standard);
    if (!integer || integer->negative || !fits(*integer, sync.type)) {
      problems_.add(sync.where, "the header's field 'sync' has the value '" + sync.standard +
                                    "'; it needs an integer that fits " + sync.type);
      return;
    }
    // the same in both orders: it can't tell them apart
    const std::uint64_t value = integer->magnitude;
    std::uint64_t swapped = 0;
    const std::size_t size = definition::size_of(sync.type);
    for (std::size_t i = 0; i < size; ++i) swapped |= ((value >> (8 * i)) & 0xff) << (8 * (size - 1 - i));
    if (definition_.order == "either" && swapped == value)
      problems_.add(sync.where, "the sync " + sync.standard +
                                    " is the same in both byte orders; the definition needs a "
                                    "byte-order, little or big");
  }

  void resolve_message(Message& message) {
    const std::string subject = "message '" + message.name + "'";
    const std::uint64_t null_id = definition_.id_field < definition_.header.fields.size()
                                      ? largest(definition_.header.fields[definition_.id_field])
                                      : 0;
    if (null_id != 0 && message.id >= null_id)
      problems_.add(message.where, subject + " has the id " + std::to_string(message.id) + "; it needs one below " +
                                       std::to_string(null_id));
    for (Field& field : message.fields) {
      const std::string field_subject = subject + " field '" + field.name + "'";
      if (field.type == "rest" && &field != &message.fields.back())
        problems_.add(field.where, field_subject + " takes the rest of the packet; it needs to be the last");
      if (field.message_type.empty()) continue;
      if (const Message* named = find(field.message_type)) {
        field.ids = {named->id};
        const bool ends = !named->fields.empty() && named->fields.back().type == "rest";
        if (field.type == "part" && ends)
          problems_.add(field.where,
                        field_subject + " is " + named->name + ", which ends only with its packet; a part has an end");
      } else if (field.type != "part" && definition_.groups.contains(field.message_type)) {
        for (const std::string& member : definition_.groups[field.message_type])
          if (const Message* of_group = find(member)) field.ids.push_back(of_group->id);
      } else {
        report_missing(field.where, field_subject, field.message_type, field.type != "part");
      }
    }
  }

  // Bytes of payload, -1 if they depend on the value. `within`: the messages that this one is part of.
  std::int64_t size_of_message(const Message& message, std::vector<std::string> within) {
    if (std::find(within.begin(), within.end(), message.name) != within.end()) {
      problems_.add(message.where, "message '" + message.name + "' is part of itself: " + list_of(within));
      return -1;
    }
    within.push_back(message.name);
    std::int64_t sum = 0;
    for (const Field& field : message.fields) {
      const std::int64_t size =
          field.type == "part" ? size_of_message(*find(field.message_type), within)
                               : static_cast<std::int64_t>(definition::size_of(field.type) * std::max(field.count, 1U));
      if (size < 0 || (size == 0 && field.type != "part")) return -1;
      sum += size;
    }
    if (sum > static_cast<std::int64_t>(definition_.max_payload))
      problems_.add(message.where, "message '" + message.name + "' has " + std::to_string(sum) + " bytes; at most " +
                                       std::to_string(definition_.max_payload) + " fit into a packet");
    return sum;
  }

  void check_ids() {
    const auto& messages = definition_.messages;
    for (std::size_t i = 1; i < messages.size(); ++i) {
      const Message &a = messages[i - 1], &b = messages[i];
      if (a.id != b.id || (a.wire_size >= 0 && a.wire_size < b.wire_size)) continue;
      problems_.add(b.where, "message '" + b.name + "' has the id " + std::to_string(b.id) + " of '" + a.name +
                                 "'; only messages of different fixed sizes may share one");
    }
  }

  // The fields of parts stand among the message's own.
  void check_field_names(const Message& message) {
    std::set<std::string> names;
    add_names(message, message.where, message.name, names);
  }

  void add_names(const Message& message, const Location& where, const std::string& owner,
                 std::set<std::string>& names) {
    for (const Field& field : message.fields) {
      if (field.type == "part") {
        add_names(*find(field.message_type), field.where, owner, names);
      } else if (!names.insert(field.name).second) {
        problems_.add(&message.where == &where ? field.where : where,
                      "message '" + owner + "' has the field '" + field.name + "' twice; each needs a name of its own");
      }
    }
  }

  Definition& definition_;
  Problems& problems_;
};

}  // namespace

void resolve(Definition& definition, Problems& problems) { Resolver(definition, problems).resolve(); }

Definition read_definition(const Source& source) {
  Problems problems;
  Definition definition = read_xml(std::make_shared<Source>(source), problems);
  if (!definition.messages.empty()) resolve(definition, problems);
  problems.throw_if_any();
  return definition;
}

}  // namespace jarol::definition

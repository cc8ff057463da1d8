// A message set as its definition in XML has it, checked: what the C++ of the set is made from.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "graph/language/problems.h"

namespace jarol::definition {

struct NamedValue {
  std::string name;
  std::int64_t value = 0;
};

/// An enumeration or bitfield that fields share.
struct Values {
  std::string name;
  bool bits = false;
  std::vector<NamedValue> values;
};

/// A field, or a part: all fields of another message, without its id.
struct Field {
  Location where;
  std::string name;
  std::string type;  // "part" for a part
  std::string unit;
  std::string text;
  std::string min, max, standard;
  std::string message_type;        // of parts and nested messages
  std::vector<std::uint32_t> ids;  // that `message_type` stands for
  std::uint32_t count = 0;         // of a fixed array; 0: a single value
  bool bits = false;
  std::vector<NamedValue> values;
  std::string shared_values;  // name of the shared ones, else the field's own
};

struct Message {
  Location where;
  std::string name;
  std::string struct_name;
  std::uint32_t id = 0;
  std::string text;
  std::vector<Field> fields;
  std::int64_t wire_size = 0;  // bytes of payload; -1: it depends on the value
};

struct Definition {
  Location where;
  std::string name, title, version, text;
  std::vector<Values> shared;                              // enumerations and bitfields
  std::map<std::string, std::vector<std::string>> groups;  // names of messages
  Message header;
  std::size_t id_field = 0, size_field = 0;
  std::string checksum_name;  // empty: none
  std::string checksum;       // as messages::Checksum spells it
  std::string order;          // "little", "big", "either"
  std::size_t checksum_from = 0;
  std::size_t max_payload = 0;
  std::vector<Message> messages;  // by id, then by size
};

/// Bytes of a number on the wire; 0 for all other types.
std::size_t size_of(const std::string& type);

struct Integer {
  bool negative = false;
  std::uint64_t magnitude = 0;
};

/// Decimal, negative or hexadecimal; nothing if it is none or has no place in 64 bits.
std::optional<Integer> parse_integer(std::string_view text);

/// Has a field of that integer type room for it?
bool fits(const Integer& integer, const std::string& type);

/// Reads and checks a definition; throws SpecError with all that is wrong.
Definition read_definition(const Source& source);

// The steps of it, each in a file of its own.

/// What the XML says, with references by name.
Definition read_xml(const std::shared_ptr<const Source>& source, Problems& problems);
/// Finds header fields by their roles, messages by their names; computes sizes.
void resolve(Definition& definition, Problems& problems);

}  // namespace jarol::definition

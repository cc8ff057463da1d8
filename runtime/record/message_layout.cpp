#include "runtime/record/message_layout.h"

#include <fmt/format.h>
#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <sstream>
#include <utility>

namespace jarol {
namespace {

constexpr std::string_view kind_names[] = {"bool",   "int8",  "uint8",  "int16",   "uint16", "int32",
                                           "uint32", "int64", "uint64", "float32", "float64"};
constexpr std::size_t kind_sizes[] = {1, 1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
constexpr bool kind_signs[] = {false, true, false, true, false, true, false, true, false, false, false};

std::size_t size_of(NumberKind kind) { return kind_sizes[static_cast<std::size_t>(kind)]; }

std::int64_t signed_of(NumberKind kind, std::uint64_t bits) {
  const std::size_t unused = 64 - 8 * size_of(kind);
  return static_cast<std::int64_t>(bits << unused) >> unused;
}

[[noreturn]] void fail(const std::string& what) { throw LogError(what); }

template <class T>
std::string shortest(T value) {
  char text[64];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

}  // namespace

// Where reading stands in a message.
struct MessageLayout::Cursor {
  std::string_view bytes;  // after the head
  std::size_t at = 0;

  std::uint64_t number(NumberKind kind) {
    const std::size_t size = size_of(kind);
    at = (at + size - 1) / size * size;
    if (at > bytes.size() || size > bytes.size() - at) fail("a message ends before its fields do");
    std::uint64_t bits = 0;
    std::memcpy(&bits, bytes.data() + at, size);
    at += size;
    return bits;
  }
  std::uint32_t length() {
    const auto length = static_cast<std::uint32_t>(number(NumberKind::uint32));
    if (length > bytes.size() - at) fail("a message has a sequence of " + std::to_string(length) + " and fewer bytes");
    return length;
  }
};

MessageLayout::MessageLayout(const ReadTopic& topic) : MessageLayout(topic.channel.topic, topic.schema) {}

MessageLayout::MessageLayout(const std::string& topic, const std::string& schema) {
  try {
    parse(schema);
    add_columns(definitions_.at(0), "");
  } catch (const LogError& error) {
    fail("the schema of '" + topic + "' can't be read: " + error.what());
  } catch (const std::out_of_range&) { fail("the schema of '" + topic + "' can't be read: it is empty"); }
}

void MessageLayout::parse(const std::string& schema) {
  std::map<std::string, int> numbers;
  struct Open {
    std::size_t definition, field;
    std::string type;
  };
  std::vector<Open> open;
  definitions_.push_back({});
  std::istringstream lines(schema);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("=====")) continue;
    if (line.starts_with("MSG: ")) {
      numbers[line.substr(5)] = static_cast<int>(definitions_.size());
      definitions_.push_back({});
      continue;
    }
    if (line.starts_with("#")) definitions_.back().wraps = true;
    const std::size_t space = line.find(' ');
    if (space == std::string::npos || line.find('=') < line.find('#') || line[0] == '#') continue;  // no field
    std::string type = line.substr(0, space);
    Field field;
    field.name = line.substr(space + 1, line.find(' ', space + 1) - space - 1);
    if (const std::size_t unit = line.find(" # ["); unit != std::string::npos)
      field.unit = line.substr(unit + 4, line.find(']', unit) - unit - 4);
    if (const std::size_t bracket = type.find('['); bracket != std::string::npos) {
      const std::string count = type.substr(bracket + 1, type.find(']') - bracket - 1);
      field.form = count.empty() ? Field::Form::sequence : Field::Form::array;
      if (!count.empty()) std::from_chars(count.data(), count.data() + count.size(), field.count);
      constexpr std::uint32_t max = 1U << 20;
      if (!count.empty() && (field.count == 0 || field.count > max)) fail("it has an array of " + count);
      type.resize(bracket);
    }
    const auto kind = std::find(std::begin(kind_names), std::end(kind_names), type);
    if (kind != std::end(kind_names))
      field.kind = static_cast<NumberKind>(kind - std::begin(kind_names));
    else
      open.push_back({definitions_.size() - 1, definitions_.back().fields.size(), type});
    definitions_.back().fields.push_back(field);
  }
  for (const Open& o : open) {
    const auto at = numbers.find(o.type);
    if (at == numbers.end()) fail("it lacks the definition of '" + o.type + "'");
    definitions_[o.definition].fields[o.field].definition = at->second;
  }
  // of nothing there could be any number in no bytes
  for (const Definition& definition : definitions_)
    if (definition.fields.empty()) fail("one of its definitions has no fields");
  // a definition within itself would have no end
  std::vector<int> state(definitions_.size());  // 1: being looked at, 2: done
  const auto look = [&](const auto& self, std::size_t at, int depth) -> void {
    constexpr int deepest = 64;
    if (state[at] == 1 || depth > deepest) fail("its definitions are nested too deep");
    if (std::exchange(state[at], 1) == 2) return void(state[at] = 2);
    for (const Field& field : definitions_[at].fields)
      if (field.definition >= 0) self(self, static_cast<std::size_t>(field.definition), depth + 1);
    state[at] = 2;
  };
  look(look, 0, 0);
}

void MessageLayout::add_columns(const Definition& definition, const std::string& path) {
  const auto within = [](const std::string& at, const std::string& name) {
    return at.empty() ? name : at + "." + name;
  };
  for (const Field& field : definition.fields) {
    const std::string at = definition.wraps ? path : within(path, field.name);
    const auto add_one = [&](const std::string& one) {
      if (field.definition >= 0)
        add_columns(definitions_[static_cast<std::size_t>(field.definition)], one);
      else
        add_column({one, field.unit, field.kind, false});
    };
    switch (field.form) {
      case Field::Form::one: add_one(at); break;
      case Field::Form::sequence: add_column({at, field.unit, field.kind, true}); break;
      case Field::Form::array:
        for (std::uint32_t i = 0; i < field.count; ++i) add_one(within(at, std::to_string(i)));
        break;
    }
  }
}

void MessageLayout::add_column(MessageColumn column) {
  constexpr std::size_t max = 1U << 20, max_bytes = 1U << 26;
  name_bytes_ += column.path.size() + column.unit.size();
  if (columns_.size() == max) fail("it has more than " + std::to_string(max) + " fields");
  if (name_bytes_ > max_bytes) fail("the names of its fields are longer than " + std::to_string(max_bytes) + " bytes");
  columns_.push_back(std::move(column));
}

std::vector<MessageCell> MessageLayout::read(std::string_view bytes) const {
  constexpr std::size_t head = 4;
  if (bytes.size() < head) fail("a message ends before its fields do");
  Cursor in{bytes.substr(head)};
  std::vector<MessageCell> cells;
  cells.reserve(columns_.size());
  read_fields(definitions_[0], in, cells);
  if (in.at != in.bytes.size()) fail("a message goes on after its fields");
  return cells;
}

void MessageLayout::read_fields(const Definition& definition, Cursor& in, std::vector<MessageCell>& cells) const {
  for (const Field& field : definition.fields) {
    if (field.form == Field::Form::sequence) {
      const std::uint32_t count = in.length();
      cells.push_back({0, text_of(field, in, count)});
      continue;
    }
    const std::uint32_t count = field.form == Field::Form::array ? field.count : 1;
    for (std::uint32_t i = 0; i < count; ++i) {
      if (field.definition >= 0)
        read_fields(definitions_[static_cast<std::size_t>(field.definition)], in, cells);
      else
        cells.push_back({in.number(field.kind)});
    }
  }
}

// Bytes that are a line of text in quotes, all else as a list, of structs in braces.
std::string MessageLayout::text_of(const Field& field, Cursor& in, std::uint32_t count) const {
  if (field.definition < 0 && field.kind == NumberKind::uint8 && count > 0) {
    const std::string_view bytes = in.bytes.substr(in.at, count);
    const auto prints = [](char c) { return c >= ' ' && c <= '~' && c != '"' && c != '\\'; };
    if (std::all_of(bytes.begin(), bytes.end(), prints)) {
      in.at += count;
      return "\"" + std::string(bytes) + "\"";
    }
  }
  std::string text = "[";
  for (std::uint32_t i = 0; i < count; ++i) {
    if (i > 0) text += " ";
    if (field.definition < 0) {
      text += jarol::text_of(field.kind, in.number(field.kind));
      continue;
    }
    text += "{";
    for (const Field& inner : definitions_[static_cast<std::size_t>(field.definition)].fields) {
      if (text.back() != '{') text += " ";
      Field one = inner;
      one.form = Field::Form::one;
      const std::uint32_t inner_count = inner.form == Field::Form::sequence ? in.length()
                                        : inner.form == Field::Form::array  ? inner.count
                                                                            : 1;
      text += text_of(one, in, inner_count);
    }
    text += "}";
  }
  return text + "]";
}

std::string text_of(NumberKind kind, std::uint64_t bits) {
  if (kind == NumberKind::float64) return shortest(std::bit_cast<double>(bits));
  if (kind == NumberKind::float32) return shortest(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
  return kind_signs[static_cast<std::size_t>(kind)] ? shortest(signed_of(kind, bits)) : shortest(bits);
}

std::string text_of(const MessageColumn& column, const MessageCell& cell) {
  return column.is_sequence ? cell.text : text_of(column.kind, cell.bits);
}

double number_of(NumberKind kind, std::uint64_t bits) {
  if (kind == NumberKind::float64) return std::bit_cast<double>(bits);
  if (kind == NumberKind::float32) return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
  return kind_signs[static_cast<std::size_t>(kind)] ? static_cast<double>(signed_of(kind, bits))
                                                    : static_cast<double>(bits);
}

double distance(NumberKind kind, std::uint64_t a, std::uint64_t b) {
  return std::abs(number_of(kind, a) - number_of(kind, b));
}

std::string bits_text(NumberKind kind, std::uint64_t bits) { return fmt::format("0x{:0{}x}", bits, 2 * size_of(kind)); }

}  // namespace jarol

#include "tools/commands/run/packet_lines.h"

#include <iostream>
#include <nlohmann/json.hpp>

#include "distributers/messages/json.h"
#include "distributers/messages/limits.h"
#include "distributers/messages/packet.h"
#include "graph/language/problems.h"
#include "tools/report/exit_code.h"

namespace jarol::tools {
namespace {

using messages::ByteOrder;
using messages::PacketError;
using Bytes = std::vector<std::byte>;
using Json = nlohmann::ordered_json;

// What is wrong with a line.
struct Wrong {
  std::string text;
};

constexpr std::string_view space = " \t\r";

constexpr std::size_t longest_line = std::size_t{1} << 20;

// Of one that is too long no more than shows that it is.
bool next_line(std::istream& in, std::string& line) {
  line.clear();
  bool any = false;
  for (int c = 0; (c = in.get()) != std::istream::traits_type::eof() && c != '\n'; any = true)
    if (line.size() <= longest_line) line += static_cast<char>(c);
  return any || in;
}

// An object that is nested no deeper than messages may be.
Json parse_object(const std::string& line) {
  constexpr int deepest = 64;
  const auto check_depth = [](int depth, Json::parse_event_t, const Json&) {
    if (depth > deepest) throw Wrong{"the line is nested deeper than " + std::to_string(deepest) + " levels"};
    return true;
  };
  Json packet = Json::parse(line, check_depth, false);
  if (!packet.is_object())
    throw Wrong{R"(the line is no JSON object; it needs {"name": ..., "header": ..., "fields": ...})"};
  return packet;
}

// Calls act(line, number) for every line that is not empty; returns the worst exit code.
template <class Act>
int for_each_line(std::istream& in, std::ostream& errors, Act act) {
  int exit_code = exit_good;
  std::size_t number = 0;
  for (std::string line; next_line(in, line);) {
    ++number;
    if (line.find_first_not_of(space) == std::string::npos) continue;
    try {
      if (line.size() > longest_line)
        throw Wrong{"the line is longer than " + std::to_string(longest_line >> 10) + " KiB; a packet has 64 at most"};
      exit_code = std::max(exit_code, act(line));
    } catch (const Wrong& wrong) {
      errors << "line " << number << ": error: " << wrong.text << "\n";
      exit_code = exit_input;
    }
  }
  return exit_code;
}

Bytes bytes_of(const std::string& line) {
  Bytes bytes;
  int half = -1;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (space.find(c) != std::string_view::npos) continue;
    const int digit = c >= '0' && c <= '9'   ? c - '0'
                      : c >= 'a' && c <= 'f' ? c - 'a' + 10
                      : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                             : -1;
    if (digit < 0)
      throw Wrong{"column " + std::to_string(i + 1) + " is no hexadecimal digit; a packet is two of them a byte"};
    if (half >= 0) bytes.push_back(static_cast<std::byte>(16 * half + digit));
    half = half >= 0 ? -1 : digit;
  }
  if (half >= 0) throw Wrong{"the packet has an odd number of hexadecimal digits; it needs two a byte"};
  return bytes;
}

std::string hex_of(const Bytes& bytes) {
  std::string hex;
  for (const std::byte b : bytes) {
    hex += "0123456789abcdef"[std::to_integer<int>(b) / 16];
    hex += "0123456789abcdef"[std::to_integer<int>(b) % 16];
  }
  return hex;
}

ByteOrder order_in(const Json& packet, const messages::MessageSet& set) {
  if (!packet.contains("order")) return set.order;
  const Json& order = packet["order"];
  const ByteOrder named = order == "big" ? ByteOrder::big : ByteOrder::little;
  const bool known = order == "big" || order == "little";
  if (known && (set.either_order || named == set.order)) return named;
  throw Wrong{"\"order\" is " + order.dump() + "; it needs " +
              (set.either_order              ? R"("little" or "big")"
               : set.order == ByteOrder::big ? R"("big")"
                                             : R"("little")")};
}

messages::Message message_of(const messages::MessageDescriptor& descriptor, const Json& packet, const char* key) {
  messages::Message message(descriptor);
  std::string why;
  if (packet.contains(key) && !messages::from_json(packet[key].dump(), message, why)) throw Wrong{why};
  return message;
}

const messages::MessageDescriptor& descriptor_in(const Json& packet, const messages::MessageSet& set) {
  if (!packet.contains("name") || !packet["name"].is_string())
    throw Wrong{"the packet has no \"name\"; it needs that of a message of set " + std::string(set.name)};
  const auto& name = packet["name"].get_ref<const std::string&>();
  if (const auto* descriptor = set.find(std::string_view(name))) return *descriptor;
  std::vector<std::string> names;
  for (const auto* m : set.messages) names.emplace_back(m->name);
  throw Wrong{"set " + std::string(set.name) + " has no message '" + name + "'" + did_you_mean(name, names)};
}

void check_keys(const Json& packet) {
  static const std::vector<std::string> keys{"name", "header", "fields", "order", "crc_ok", "outside", "hex"};
  for (const auto& [key, value] : packet.items())
    if (std::find(keys.begin(), keys.end(), key) == keys.end())
      throw Wrong{"the packet has a key '" + key + "'" + did_you_mean(key, keys) + "; it may have: " + list_of(keys)};
}

}  // namespace

int decode_lines(const messages::MessageSet& set, std::istream& in, std::ostream& out, std::ostream& errors) {
  messages::PacketReader reader(set);
  return for_each_line(in, errors, [&](const std::string& line) -> int {
    const Bytes bytes = bytes_of(line);
    std::string why;
    const PacketError packet_error = reader.read(bytes, &why);
    if (reader.message().descriptor == nullptr) throw Wrong{why};
    out << R"({"name":)" << Json(reader.message().descriptor->name) << R"(,"header":)"
        << messages::to_json(reader.header()) << R"(,"fields":)" << messages::to_json(reader.message())
        << R"(,"crc_ok":)" << Json(packet_error == PacketError::none);
    if (reader.order() != set.order)
      out << R"(,"order":)" << (reader.order() == ByteOrder::big ? R"("big")" : R"("little")");
    const std::vector<std::string> outside = messages::find_outside(reader.message());
    if (!outside.empty()) out << R"(,"outside":)" << Json(outside);
    out << R"(,"hex":")" << hex_of(bytes) << "\"}" << std::endl;  // whoever listens may be waiting for it
    return packet_error == PacketError::none ? exit_good : exit_negative;
  });
}

int encode_lines(const messages::MessageSet& set, std::istream& in, std::ostream& out, std::ostream& errors) {
  return for_each_line(in, errors, [&](const std::string& line) -> int {
    const Json packet = parse_object(line);
    check_keys(packet);
    const messages::Message message = message_of(descriptor_in(packet, set), packet, "fields");
    const messages::Message header = message_of(*set.header, packet, "header");
    Bytes bytes;
    std::string why;
    if (!messages::write_packet(header, message, order_in(packet, set), bytes, &why)) throw Wrong{why};
    out << hex_of(bytes) << std::endl;
    return exit_good;
  });
}

}  // namespace jarol::tools

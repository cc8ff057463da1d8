// Integers as definitions spell them: decimal, negative or hexadecimal.
#include <charconv>

#include "tools/messages/definition.h"

namespace jarol::definition {

std::optional<Integer> parse_integer(std::string_view text) {
  Integer integer;
  integer.negative = text.starts_with('-');
  if (integer.negative) text.remove_prefix(1);
  const bool hex = text.starts_with("0x") || text.starts_with("0X");
  if (hex) text.remove_prefix(2);
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, integer.magnitude, hex ? 16 : 10);
  if (error != std::errc() || stop != end) return std::nullopt;
  return integer;
}

bool fits(const Integer& integer, const std::string& type) {
  const std::uint64_t all = ~std::uint64_t{0} >> (64 - 8 * size_of(type));
  if (type[0] == 'u') return integer.magnitude <= all && (!integer.negative || integer.magnitude == 0);
  return integer.magnitude <= all / 2 + (integer.negative ? 1 : 0);
}

std::size_t size_of(const std::string& type) {
  static const std::map<std::string, std::size_t> sizes{
      {"int8_t", 1},   {"uint8_t", 1}, {"int16_t", 2},  {"uint16_t", 2}, {"int32_t", 4},
      {"uint32_t", 4}, {"int64_t", 8}, {"uint64_t", 8}, {"fp32_t", 4},   {"fp64_t", 8}};
  const auto found = sizes.find(type);
  return found == sizes.end() ? 0 : found->second;
}

}  // namespace jarol::definition

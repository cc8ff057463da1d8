// Packets of real peers, from tests/data.
#pragma once

#include <cstddef>
#include <fstream>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace jarol::messages {

inline std::vector<std::byte> bytes_of(const std::string& hex) {
  std::vector<std::byte> bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    bytes.push_back(static_cast<std::byte>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  return bytes;
}

inline std::string hex_of(std::span<const std::byte> bytes) {
  std::string hex;
  for (const std::byte b : bytes) {
    hex += "0123456789abcdef"[std::to_integer<int>(b) / 16];
    hex += "0123456789abcdef"[std::to_integer<int>(b) % 16];
  }
  return hex;
}

inline std::vector<nlohmann::json> recorded(const std::string& file) {
  std::vector<nlohmann::json> packets;
  std::ifstream in("tests/data/" + file);
  for (std::string line; std::getline(in, line);) packets.push_back(nlohmann::json::parse(line));
  return packets;
}

}  // namespace jarol::messages

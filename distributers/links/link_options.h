// What a link may be made with.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "distributers/links/ownership.h"
#include "distributers/links/secret_key.h"

namespace jarol::distributers {

enum class PortKind { plain, push };

struct PortOptions {
  PortKind kind = PortKind::plain;
  std::size_t packets = 64;
};

struct LinkOptions {
  PortOptions input{PortKind::push, 256};  // a vehicle may send a thousand in a second, in bursts
  PortOptions output{PortKind::plain};
  std::vector<std::pair<std::string, std::uint64_t>> header{};  // fields of the packets sent, as the sender's id
  std::vector<std::pair<std::string, std::uint64_t>> accept{};  // of packets received; others are dropped
  std::optional<SecretKey> key{};                               // with which packets are sealed, both ways
  std::chrono::nanoseconds silence = Ownership::default_silence;
};

}  // namespace jarol::distributers

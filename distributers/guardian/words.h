// What a program and its guardian say to each other, over a pair of sockets: one word at a time, with bytes and at most
// one descriptor. Both are the same program, so words go as they lie in memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "distributers/links/descriptor.h"

namespace jarol::distributers {

enum class Word : std::uint32_t {
  link,          // the next link; bytes: Stamping, then its text
  packet,        // of a link: one of those that bring its system to rest; bytes: the packet
  key,           // of a link whose packets are sealed; bytes: GuardianKey
  ready,         // all that was said is understood: asked by the program, answered by the guardian; bytes: Urgency
  hold,          // of a link: its way to the peers, a descriptor; bytes: a sockaddr_storage for each
  let_go,        // of a link: it has no way any more
  self_steered,  // of a link: what is there steers itself, so that nothing is sent
  steered,       // of a link: it no longer does
  armed,         // from now on the end of the program is a crash, unless it says `closed` before
  crashed,       // the program is about to end
  closed,        // the program ends in good order
};

struct Sentence {
  Word word{};
  std::uint32_t link = 0;
};

/// The longest packet of any message set, and more.
inline constexpr std::size_t longest_words = std::size_t{66} << 10;

/// False: the other one is gone, or its socket is full. Never waits; may be called in a signal handler.
bool say(int socket, Sentence sentence, std::span<const std::byte> bytes = {}, int fd = -1);

struct Heard {
  Sentence sentence;
  std::span<const std::byte> bytes;  // in the room of `hear`
  Descriptor fd;
};

/// Waits for the next words; none: the other one is gone.
std::optional<Heard> hear(int socket, std::span<std::byte> room);

}  // namespace jarol::distributers

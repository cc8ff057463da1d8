// Packets between two processes that share a key: each proves who made it and that it is new.
//
// A sealed packet is, little-endian: "JK1", a kind (1), the length of its content (4), the sender's session (8), a
// number (8), the content, and a tag (16): keyed BLAKE2b of all before it. A session is a random number that a process
// takes for a link; the numbers of its packets grow. Content counts only in a session that the receiver knows, and each
// number once, within a window of 64 below the greatest.
//
// Sessions are introduced by a challenge: packets of kind `hello` hold the challenge that their sender heard last from
// the other end (or zeros) and one of its own. Who sees its own challenge in a hello knows that this was made after it,
// by one that has the key: it takes a new session over, counts from the hello's number on, and takes another challenge,
// so that nothing recorded before, in whatever session, counts again. A hello answers each packet of a session that is
// not known, each hello without the right challenge, and the one that began a session.
//
// A guardian that speaks after the end of a process gets no more than a key made of the link's and that process's
// session, for content of kind `last`, numbered from 2^63: what the process has sent before, and is still on its way or
// was held up, counts no more once such content was taken, and with the next session neither does the guardian's.
//
// What this does not give: secrecy; a packet that is held up, or kept from arriving, for as long as a link waits; a
// difference between links that share a key and a message set, or between the two ends; a peer that was taken over.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "distributers/links/secret_key.h"

namespace jarol::distributers {

/// With which a guardian seals: good for nothing but the last words of one session. Goes over sockets as it lies in
/// memory.
struct GuardianKey {
  SecretKey key{};
  std::uint64_t session = 0;
};

/// Seals what a process leaves to be sent after its end.
class GuardianSeal {
 public:
  explicit GuardianSeal(const GuardianKey& key) : key_(key) {}
  /// Replaces `to` by the packet, sealed.
  void seal(std::span<const std::byte> packet, std::vector<std::byte>& to);

 private:
  GuardianKey key_;
  std::uint64_t number_ = std::uint64_t{1} << 63;
};

/// Of one end of a link. `seal` may be called from any thread, all else from the one that receives.
class Seal {
 public:
  static constexpr std::size_t head_size = 24, tag_size = 16, overhead = head_size + tag_size;

  /// `context`: what both ends use the key for, as the name of their message set.
  Seal(const SecretKey& key, std::string_view context);

  /// Replaces `to` by the packet, sealed.
  void seal(std::span<const std::byte> packet, std::vector<std::byte>& to);

  /// For content that is sent after this end has gone, to whoever knows its session.
  GuardianKey guardian_key() const;

  enum class Finding : std::uint8_t { content, hello, no_key, truncated, wrong_key, unknown_session, replayed };
  static constexpr std::size_t finding_count = 7;
  struct Opened {
    Finding finding;
    std::span<const std::byte> content{};  // within what was opened
    bool fresh = false;                    // made by one that has the key, after this end began, and never seen
  };
  /// Of bytes that should be one sealed packet.
  Opened open(std::span<const std::byte> sealed);

  /// The hello that is due after the last `open`, or nothing.
  std::span<const std::byte> answer() const { return answer_; }
  /// A hello to begin with, before anything was heard.
  std::vector<std::byte> hello();

  /// Has the other end proved itself?
  bool knows_peer() const { return peer_.has_value(); }

  /// Was it made with this key, new or not? For bytes of which at least the first packet is there as a whole.
  bool is_authentic(std::span<const std::byte> sealed) const;

  /// Do they begin as a sealed packet does, whatever its key?
  static bool is_sealed(std::span<const std::byte> bytes);
  /// Bytes of the whole packet, of whose begin there is at least `head_size`.
  static std::size_t size_of(std::span<const std::byte> bytes);

 private:
  using Challenge = std::array<std::byte, 16>;

  void write_hello(const Challenge& echo, std::vector<std::byte>& to) const;
  Opened open_hello(std::uint64_t session, std::uint64_t number, std::span<const std::byte> content);
  bool is_new(std::uint64_t number);

  SecretKey key_;
  std::uint64_t session_ = 0;
  std::atomic<std::uint64_t> number_{0};
  Challenge challenge_{};
  std::vector<std::byte> answer_;

  std::optional<std::uint64_t> peer_;  // its session
  std::uint64_t greatest_ = 0;         // number of its packets
  std::uint64_t seen_ = 0;             // bit i: that of i below the greatest
};

/// In words, as in "wrong key".
std::string_view name_of(Seal::Finding finding);

}  // namespace jarol::distributers

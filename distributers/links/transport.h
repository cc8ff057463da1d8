// How bytes get to a peer and from it: UDP, TCP, serial. What they mean is not known here.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "distributers/links/address.h"
#include "distributers/links/descriptor.h"
#include "distributers/links/holder.h"
#include "distributers/links/ownership.h"

namespace jarol::distributers {

/// Takes what a transport receives, in its receiving thread.
class ByteSink {
 public:
  virtual ~ByteSink() = default;
  /// One datagram of the peer of that number, or the next piece of a stream, whose peers have none; several at once
  /// have one number. True if there was anything valid in it: its sender is the peer, or one of them.
  virtual bool take(std::span<const std::byte> bytes, std::uint32_t peer = 0) = 0;
  /// What has to go at once to the sender of what was taken last, or nothing.
  virtual std::span<const std::byte> answer() { return {}; }
  /// Is there anything valid in these, the first bytes of another stream? It is not taken by that.
  virtual bool is_valid_begin(std::span<const std::byte>) const { return false; }
  /// Nothing that follows in the stream can be understood.
  virtual bool is_broken() const { return false; }
  /// A stream begins anew: what was left of the one before is lost.
  virtual void begin_stream() = 0;
};

/// Counted by the transport, reported by its link.
struct TransportCounts {
  std::atomic<std::uint64_t> connected{0};     // how often there was a new peer
  std::atomic<std::uint64_t> disconnected{0};  // how often a stream ended or failed
  std::atomic<std::uint64_t> strangers{0};     // datagrams and connections of others than the peer
  std::atomic<std::uint64_t> closed{0};        // how often the peer's port turned out to be closed
  std::atomic<std::uint64_t> overflown{0};     // datagrams that the system had no room for before the last one received
  std::atomic<std::uint64_t> unsent{0};        // packets that could not be sent
};

class Transport {
 public:
  virtual ~Transport() = default;

  /// As in "udp 127.0.0.1:7000".
  virtual std::string text() const = 0;

  /// Where others reach it once it is open, as in "udp://127.0.0.1:6001"; empty: nowhere.
  virtual std::string address() const { return {}; }

  /// To whom this end announces where it can be reached; none: to nobody.
  virtual std::vector<Address> announces_to() const { return {}; }

  /// What is wrong with how it is set up, though it works, as in "announces itself where ..."; empty: nothing.
  virtual std::string doubt() const { return {}; }

  /// Takes hold of what must be there from the begin, as a port to listen at. Throws InputError with the cause.
  virtual void open() = 0;

  /// Receives until interrupted; a peer that is lost is looked for again, at growing intervals up to a second. What it
  /// throws ends the run, with that cause: the external system is lost.
  virtual void receive(const Interrupter& interrupter, ByteSink& sink) = 0;

  /// Sends one packet, from one other thread. False if there is no peer or it can't be sent. What it throws ends the
  /// run likewise, and nothing more is sent, no `safe` either.
  virtual bool send(std::span<const std::byte> packet) = 0;

  /// Lets go of everything; after that it can be opened again. Throws nothing.
  virtual void close() = 0;

  /// It shows its way to the peer to `holder`; else nobody can hand over `safe` there once the program is gone.
  virtual bool can_be_held() const { return false; }

  /// Whose it is; none: whoever is at the other end of a line, or of a connection that this end has made.
  virtual const Ownership* ownership() const { return nullptr; }

  TransportCounts counts;
  Holder* holder = nullptr;  // who else holds the way to the peer, if anybody; set before `open`
};

}  // namespace jarol::distributers

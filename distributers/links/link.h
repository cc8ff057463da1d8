// A link: packets of a message set to a peer and from it, by threads of its own.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "distributers/links/announcer.h"
#include "distributers/links/link_options.h"
#include "distributers/links/translator.h"
#include "runtime/jarol/signal.h"

namespace jarol::distributers {

/// Connect, disconnect, send and receive belong to one thread, which never waits but in `disconnect`.
class Link {
 public:
  /// Throws InputError if the set's header has no such integer field.
  Link(std::unique_ptr<Transport> transport, const messages::MessageSet& set, const LinkOptions& options);
  ~Link();

  /// Begins to receive and to send; nothing if it has begun. Throws InputError if a port or line is not to be
  /// had, or no thread.
  void connect();
  /// Sends what is pending and ends; nothing if it has ended.
  void disconnect();

  /// Gives the receiver the packets that have arrived, oldest first; no more than the port holds, however fast others
  /// come. Throws Unfinished with the cause once the transport has thrown where it receives or sends.
  void receive(messages::Receiver& receiver);
  /// Who sent the packet that was given last: datagrams' peers are numbered from 1, several at once have one number; 0:
  /// it came in a stream.
  std::uint32_t peer() const { return entries_.peer(); }

  /// The packet that `send` would make of a message now.
  std::span<const std::byte> encode(messages::MessageRef message);
  const messages::MessageSet& set() const { return set_; }
  /// None: packets go out as `encode` gives them.
  std::optional<GuardianKey> guardian_key() const {
    return seal_ ? std::optional(seal_->guardian_key()) : std::nullopt;
  }
  /// From the next `connect` on it learns of the way to the peer; it outlives the link. None: null.
  void hold_by(Holder* holder) { transport_->holder = holder; }
  /// The holder learns whether what is at the other end steers itself. False: it could not be reported.
  bool set_steers_itself(bool steers_itself) {
    return transport_->holder == nullptr || transport_->holder->set_steers_itself(steers_itself);
  }

  /// Has the message sent as a packet soon. One that finds no room is counted and dropped.
  void send(messages::MessageRef message);
  /// Is there anybody to announce anything to?
  bool announces() const { return announcer_ != nullptr; }
  /// As of Announcer.
  std::vector<std::pair<std::string, std::uint64_t>> unsent_announcements() const {
    return announcer_ ? announcer_->unsent() : std::vector<std::pair<std::string, std::uint64_t>>{};
  }
  /// The same for all who may look for this system, in place of the peer.
  void announce(messages::MessageRef message);
  /// Wakes the sending thread for what was given to `send` and `announce` since the last call. Throws
  /// Unfinished with the cause once the transport has thrown where it sends.
  void flush();

  /// Between `connect` and the time when all that was given to `send` has gone out; any thread.
  bool sends() const { return sends_; }

  /// Packets that found no room in the port, or that the transport could not send. By the thread that sends, or once
  /// it is disconnected.
  std::uint64_t unsent() const { return refused_ + transport_->counts.unsent; }
  bool has_sent() const { return packets_out_ > 0; }

  const Transport& transport() const { return *transport_; }
  LinkReport report() const;
  /// Packets that came and counted, so far; any thread.
  std::uint64_t heard() const { return translator_.heard(); }

 private:
  // What ended one of its threads, for the thread that uses the link.
  struct Failure {
    std::string text;  // written before `failed`
    std::atomic<bool> failed{false};
  };
  template <class Work>
  static void run(Failure& failure, Work work);
  void open_transport();
  void require_works(const Failure& thread, const char* what) const;

  messages::Message& header_of(messages::MessageRef message);
  static PacketPorts make_port(const PortOptions& options, std::size_t longest);
  void run_sender();
  void send_pending(std::vector<std::byte>& room, std::vector<std::byte>& sealed);

  const messages::MessageSet& set_;
  std::unique_ptr<Transport> transport_;
  std::size_t longest_;
  PacketPorts input_, output_;
  std::unique_ptr<Announcer> announcer_;  // null: nobody looks for it
  std::unique_ptr<PacketPort> announcements_;
  std::unique_ptr<Seal> seal_;
  Translator translator_;  // used by the receiving thread
  Interrupter interrupter_;
  Signal send_signal_;
  Failure receiving_, sending_;
  std::thread receiver_, sender_;
  bool connected_ = false;

  // of the thread that sends and receives
  EntryReader entries_;
  messages::Message header_;                    // what the link says of all that it sends
  messages::Message default_header_;            // of the set
  messages::Message own_header_;                // of a message that says something itself
  const messages::FieldDescriptor* timestamp_;  // of the header
  std::vector<std::byte> packet_;
  std::uint64_t given_ = 0;
  std::uint64_t refused_ = 0;  // the output port was full
  std::uint64_t busy_ = 0;     // the sender was, when it was signalled

  std::atomic<std::uint64_t> queued_{0};  // packets in the output port so far
  std::atomic<bool> ending_{false}, sends_{false};
  std::atomic<std::uint64_t> packets_out_{0}, bytes_out_{0};
};

}  // namespace jarol::distributers

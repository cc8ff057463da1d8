// What transports share whose bytes come in streams: TCP either way, and serial lines.
#pragma once

#include <atomic>
#include <mutex>
#include <vector>

#include "distributers/links/transport.h"

namespace jarol::distributers {

/// After the end of a stream comes a pause before the next. It grows, unless the stream was good: something valid came
/// in it, or it lasted longer than the longest pause.
class StreamTransport : public Transport {
 public:
  void receive(const Interrupter& interrupter, ByteSink& sink) override;
  bool send(std::span<const std::byte> packet) override;
  bool can_be_held() const override { return true; }
  void close() override;

 protected:
  explicit StreamTransport(std::chrono::nanoseconds silence = Ownership::default_silence) : ownership_(silence) {}

  /// One try to get a stream; none if there is no peer now. It does not wait where peers are announced.
  virtual Descriptor get_stream() = 0;
  /// A descriptor that becomes readable when a peer comes, also while there is one already; none: only time helps.
  virtual int announces_peer() const { return -1; }

  Ownership ownership_;  // where peers are announced

 private:
  enum class End { good, bad, interrupted };
  enum class Piece { none, other, valid, end };
  struct Waiting {
    Descriptor stream;
    Address peer;
  };

  void replace(Descriptor stream);
  void await_delivery();
  void turn_away(const Address& peer);
  // Until the stream ends or another peer takes its place.
  End receive_stream(const Interrupter& interrupter, ByteSink& sink, const Address& peer);
  // What has arrived.
  Piece take_piece(ByteSink& sink);
  static bool speaks_validly(const Waiting& waiting, const ByteSink& sink);
  void collect_waiting(const ByteSink& sink);
  bool is_displaced(const ByteSink& sink, bool valid);

  std::mutex stream_mutex_;
  Descriptor stream_;
  std::vector<Waiting> waiting_;    // peers that may take the place; of the receiving thread
  std::atomic<bool> stuck_{false};  // the last send waited in vain
};

}  // namespace jarol::distributers

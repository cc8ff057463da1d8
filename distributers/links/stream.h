// What transports share whose bytes come in streams: TCP either way, and serial lines.
#pragma once

#include <mutex>

#include "distributers/links/transport.h"

namespace jarol::distributers {

class StreamTransport : public Transport {
 public:
  void receive(const Interrupter& interrupter, ByteSink& sink) override;
  bool send(std::span<const std::byte> packet) override;
  void close() override;

 protected:
  /// One try to get a stream; none if there is no peer now, and then `wait_for_peer` comes before the next.
  virtual Descriptor get_stream() = 0;
  /// A descriptor that becomes readable when a peer comes, also while there is one already; none: only time helps.
  virtual int announces_peer() const { return -1; }

 private:
  void replace(Descriptor stream);
  // Until the stream ends or another peer takes its place.
  bool receive_stream(const Interrupter& interrupter, ByteSink& sink);

  std::mutex stream_mutex_;
  Descriptor stream_;
};

}  // namespace jarol::distributers

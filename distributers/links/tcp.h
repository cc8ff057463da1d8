// Streams over TCP: as the one that connects, or the one that listens.
#pragma once

#include "distributers/links/address.h"
#include "distributers/links/stream.h"

namespace jarol::distributers {

/// A socket that listens and does not block. Throws std::runtime_error with the cause.
Descriptor listen_at(const Address& address);
/// Whoever has connected to a socket that listens; none: nobody waits.
Descriptor accept_from(const Descriptor& socket);

/// Connects, and again after a pause when the stream has ended.
class TcpClient : public StreamTransport {
 public:
  explicit TcpClient(const Address& peer) : peer_(peer) {}
  std::string text() const override { return "tcp to " + peer_.text(); }
  void open() override {}

 protected:
  Descriptor get_stream() override;

 private:
  Address peer_;
};

/// One peer at a time. One that speaks keeps its place: others are turned away until nothing valid has come from it for
/// a second. Then the newer one takes its place as soon as it speaks itself, or when nothing can be sent to the old
/// one: it may have been started anew without the end of its old stream. So two clients don't push each other out for
/// ever.
class TcpServer : public StreamTransport {
 public:
  explicit TcpServer(const Address& listen) : listen_(listen) {}
  std::string text() const override { return "tcp at " + listen_.text(); }
  std::string address() const override { return "tcp://" + listen_.with_port(port()).text(); }
  void open() override { socket_ = listen_at(listen_); }
  void close() override;

  /// The port that it listens at.
  int port() const { return port_of(socket_); }

 protected:
  Descriptor get_stream() override { return accept_from(socket_); }
  int announces_peer() const override { return socket_.get(); }

 private:
  Address listen_;
  Descriptor socket_;
};

}  // namespace jarol::distributers

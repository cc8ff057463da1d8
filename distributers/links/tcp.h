// Streams over TCP: as the one that connects, or the one that listens.
#pragma once

#include "distributers/links/address.h"
#include "distributers/links/stream.h"

namespace jarol::distributers {

struct LinkType;

/// The link types `tcp_client` and `tcp_server`.
LinkType tcp_client_link();
LinkType tcp_server_link();

/// A socket that listens and does not block. Throws InputError with the cause.
Descriptor listen_at(const Address& address, int backlog = 1);
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

/// One peer at a time. The link is that of the first that speaks validly (ownership.h), others are turned away; who is
/// connected without a valid word gives way to the first who says one. One that has been silent for long gives way as
/// well, also to one that says nothing when nothing can be sent to it: it may have been started anew without the end of
/// its old stream.
class TcpServer : public StreamTransport {
 public:
  explicit TcpServer(const Address& listen, std::chrono::nanoseconds silence = Ownership::default_silence)
      : StreamTransport(silence), listen_(listen) {}
  std::string text() const override { return "tcp at " + listen_.text(); }
  std::string address() const override { return "tcp://" + listen_.with_port(port()).text(); }
  void open() override { socket_ = listen_at(listen_, backlog); }
  void close() override;
  const Ownership* ownership() const override { return &ownership_; }

  /// The port that it listens at.
  int port() const { return port_of(socket_); }

 protected:
  Descriptor get_stream() override { return accept_from(socket_); }
  int announces_peer() const override { return socket_.get(); }

 private:
  static constexpr int backlog = 16;  // connections that come between two looks

  Address listen_;
  Descriptor socket_;
};

}  // namespace jarol::distributers

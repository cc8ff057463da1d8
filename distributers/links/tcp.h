// Streams over TCP: as the one that connects, or the one that listens.
#pragma once

#include "distributers/links/address.h"
#include "distributers/links/stream.h"

namespace jarol::distributers {

/// Connects, and again when the stream has ended.
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

/// One peer at a time: a new one takes the place of the old one.
class TcpServer : public StreamTransport {
 public:
  explicit TcpServer(const Address& listen) : listen_(listen) {}
  std::string text() const override { return "tcp at " + listen_.text(); }
  void open() override;
  void close() override;

  /// The port that it listens at; of "0" the one that the system chose.
  int port() const;

 protected:
  Descriptor get_stream() override;
  int announces_peer() const override { return socket_.get(); }

 private:
  Address listen_;
  Descriptor socket_;
};

}  // namespace jarol::distributers

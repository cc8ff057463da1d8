#include "distributers/links/tcp.h"

#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>

#include <cerrno>
#include <cstring>

#include "distributers/links/packet_link.h"
#include "graph/text/errors.h"

namespace jarol::distributers {
namespace {

struct ClientSpec : PacketLinkSpec {
  Maybe<std::string> peer;
};

struct ServerSpec : PacketLinkSpec {
  Maybe<std::string> listen;
};

constexpr int connect_limit = 1000;  // ms

// Packets are small and wait for nothing.
void send_at_once(int fd) {
  const int on = 1;
  setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
}

bool finish_connecting(int fd) {
  pollfd polled{fd, POLLOUT, 0};
  if (poll(&polled, 1, connect_limit) != 1) return false;
  int error = 0;
  socklen_t size = sizeof error;
  return getsockopt(fd, SOL_SOCKET, SO_ERROR, &error, &size) == 0 && error == 0;
}

}  // namespace

Descriptor TcpClient::get_stream() {
  Descriptor made(socket(peer_.family(), SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!made) return {};
  if (connect(made.get(), peer_.get(), peer_.size()) != 0 && (errno != EINPROGRESS || !finish_connecting(made.get())))
    return {};
  if (is_connected_to_itself(made)) {
    break_off(std::move(made));
    return {};
  }
  send_at_once(made.get());
  return made;
}

Descriptor listen_at(const Address& address, int backlog) {
  Descriptor made(socket(address.family(), SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  const int on = 1;
  if (made) setsockopt(made.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  if (!made || bind(made.get(), address.get(), address.size()) != 0 || listen(made.get(), backlog) != 0)
    throw InputError("can't listen at tcp " + address.text() + ": " + std::strerror(errno));
  return made;
}

Descriptor accept_from(const Descriptor& socket) {
  Descriptor stream(accept4(socket.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
  if (stream) send_at_once(stream.get());
  return stream;
}

void TcpServer::close() {
  StreamTransport::close();
  socket_.close();
}

LinkType tcp_client_link() {
  return packet_link<ClientSpec>(
      "tcp_client", "a stream, to where somebody listens", {.key = true},
      {key<&ClientSpec::peer>("peer", Form::address, "address and port to connect to", true)},
      [](const ClientSpec& spec, const Yaml&, const std::string&, Problems& problems) -> std::unique_ptr<Transport> {
        return std::make_unique<TcpClient>(read_address(spec.peer, problems));
      });
}

LinkType tcp_server_link() {
  return packet_link<ServerSpec>(
      "tcp_server", "a stream, for one who connects", {.silence = true, .key = true},
      {key<&ServerSpec::listen>("listen", Form::address, "port to listen at, with an address where not the loopback",
                                true)},
      [](const ServerSpec& spec, const Yaml&, const std::string&, Problems& problems) -> std::unique_ptr<Transport> {
        return std::make_unique<TcpServer>(read_address(spec.listen, problems), spec.silence_of_peer());
      });
}

}  // namespace jarol::distributers

// A link type, as a plugin brings it: datagrams by sockets of this machine that have a path for an address.
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>

#include "distributers/links/plugin_link.h"

namespace {
namespace links = jarol::distributers;

sockaddr_un address_of(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  path.copy(address.sun_path, sizeof address.sun_path - 1);
  return address;
}

class LocalTransport : public links::Transport {
 public:
  LocalTransport(std::string listen, std::string peer) : listen_(std::move(listen)), peer_(std::move(peer)) {}
  ~LocalTransport() override { close(); }

  std::string text() const override { return "local " + listen_ + " with " + peer_; }
  void open() override {
    const sockaddr_un address = address_of(listen_);
    socket_ = links::Descriptor(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    if (::bind(socket_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
      throw std::runtime_error("can't listen at " + text() + ": " + std::strerror(errno));
  }
  void receive(const links::Interrupter& interrupter, links::ByteSink& sink) override {
    std::array<std::byte, 65536> room;
    while (interrupter.wait(socket_.get(), std::chrono::milliseconds(-1)) == links::Interrupter::Woken::ready) {
      const ssize_t length = ::recv(socket_.get(), room.data(), room.size(), 0);
      if (length >= 0) sink.take(std::span(room).first(static_cast<std::size_t>(length)));
    }
  }
  bool send(std::span<const std::byte> packet) override {
    const sockaddr_un address = address_of(peer_);
    if (::sendto(socket_.get(), packet.data(), packet.size(), MSG_NOSIGNAL, reinterpret_cast<const sockaddr*>(&address),
                 sizeof address) >= 0)
      return true;
    ++counts.unsent;
    return false;
  }
  void close() override {
    if (!socket_) return;
    socket_.close();
    ::unlink(listen_.c_str());
  }

 private:
  const std::string listen_, peer_;
  links::Descriptor socket_;
};

struct LocalSpec : links::PacketLinkSpec {
  jarol::Maybe<std::string> listen, peer;
};

#ifdef CLASH_OF_LINKS
constexpr char name[] = "udp";
#else
constexpr char name[] = "local";
#endif

struct Local {
  static links::LinkType link_type() {
    using jarol::Form;
    return links::packet_link<LocalSpec>(
        name, "datagrams between sockets of one machine", {},
        {jarol::key<&LocalSpec::listen>("listen", Form::word, "path of the socket that this end makes", true),
         jarol::key<&LocalSpec::peer>("peer", Form::word, "path of the other end's socket", true)},
        [](const LocalSpec& spec, const jarol::Yaml&, const std::string&,
           jarol::Problems&) -> std::unique_ptr<links::Transport> {
          return std::make_unique<LocalTransport>(spec.listen->value, spec.peer->value);
        });
  }
};
}  // namespace

JAROL_PLUGIN(Local)

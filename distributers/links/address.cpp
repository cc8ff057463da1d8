#include "distributers/links/address.h"

#include <netdb.h>
#include <netinet/in.h>

#include <cstring>

#include "graph/text/errors.h"

namespace jarol::distributers {
namespace {

constexpr const char* forms = "write it as in 7000, 192.168.2.3:7000 or \"[::1]:7000\"";

bool is_port(const std::string& text) {
  return !text.empty() && text.size() <= 5 && text.find_first_not_of("0123456789") == std::string::npos &&
         std::stoi(text) <= 65535;
}

// Where a socket is bound; none: it is not.
Address own_address_of(const Descriptor& socket) {
  sockaddr_storage storage{};
  socklen_t size = sizeof storage;
  if (getsockname(socket.get(), reinterpret_cast<sockaddr*>(&storage), &size) != 0) return {};
  return Address::of(storage, size);
}

}  // namespace

Address Address::parse(const std::string& text) {
  std::string host = "127.0.0.1", port = text;
  if (const std::size_t colon = text.rfind(':'); colon != std::string::npos) {
    host = text.substr(0, colon);
    port = text.substr(colon + 1);
  }
  const bool brackets = host.size() > 1 && host.front() == '[' && host.back() == ']';
  if (!is_port(port) || host.empty() || (!brackets && host.find(':') != std::string::npos))
    throw InputError("'" + text + "' is not an address with a port; " + forms);
  if (brackets) host = host.substr(1, host.size() - 2);
  addrinfo hints{};
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = SOCK_DGRAM;
  hints.ai_flags = AI_NUMERICSERV;
  addrinfo* found = nullptr;
  if (const int error = getaddrinfo(host.c_str(), port.c_str(), &hints, &found); error != 0)
    throw InputError("the host '" + host + "' can't be found: " + gai_strerror(error));
  Address address;
  std::memcpy(&address.storage_, found->ai_addr, found->ai_addrlen);
  address.size_ = found->ai_addrlen;
  freeaddrinfo(found);
  return address;
}

Address Address::of(const sockaddr_storage& storage, socklen_t size) {
  Address address;
  address.storage_ = storage;
  address.size_ = size;
  return address;
}

int Address::port() const {
  if (family() == AF_INET6) return ntohs(reinterpret_cast<const sockaddr_in6*>(&storage_)->sin6_port);
  return ntohs(reinterpret_cast<const sockaddr_in*>(&storage_)->sin_port);
}

bool Address::is_any() const {
  if (family() == AF_INET6)
    return IN6_IS_ADDR_UNSPECIFIED(&reinterpret_cast<const sockaddr_in6*>(&storage_)->sin6_addr) != 0;
  return family() == AF_INET && reinterpret_cast<const sockaddr_in*>(&storage_)->sin_addr.s_addr == INADDR_ANY;
}

bool Address::is_loopback() const {
  if (family() == AF_INET6)
    return IN6_IS_ADDR_LOOPBACK(&reinterpret_cast<const sockaddr_in6*>(&storage_)->sin6_addr) != 0;
  return family() == AF_INET &&
         ntohl(reinterpret_cast<const sockaddr_in*>(&storage_)->sin_addr.s_addr) >> 24 == IN_LOOPBACKNET;
}

Address Address::with_port(int port) const {
  Address other = *this;
  const std::uint16_t wire = htons(static_cast<std::uint16_t>(port));
  if (family() == AF_INET6)
    reinterpret_cast<sockaddr_in6*>(&other.storage_)->sin6_port = wire;
  else
    reinterpret_cast<sockaddr_in*>(&other.storage_)->sin_port = wire;
  return other;
}

bool Address::operator==(const Address& other) const {
  if (family() != other.family() || port() != other.port()) return false;
  if (family() == AF_INET6)
    return std::memcmp(&reinterpret_cast<const sockaddr_in6*>(&storage_)->sin6_addr,
                       &reinterpret_cast<const sockaddr_in6*>(&other.storage_)->sin6_addr, sizeof(in6_addr)) == 0;
  return reinterpret_cast<const sockaddr_in*>(&storage_)->sin_addr.s_addr ==
         reinterpret_cast<const sockaddr_in*>(&other.storage_)->sin_addr.s_addr;
}

std::string Address::text() const {
  char host[NI_MAXHOST];
  if (getnameinfo(get(), size_, host, sizeof host, nullptr, 0, NI_NUMERICHOST) != 0) return "?";
  return (family() == AF_INET6 ? "[" + std::string(host) + "]" : std::string(host)) + ":" + std::to_string(port());
}

Address local_towards(const Address& peer) {
  // connecting a datagram socket sends nothing: it looks for the way
  const Descriptor made(socket(peer.family(), SOCK_DGRAM | SOCK_CLOEXEC, 0));
  const int yes = 1;
  sockaddr_storage storage{};
  socklen_t size = sizeof storage;
  if (!made || setsockopt(made.get(), SOL_SOCKET, SO_BROADCAST, &yes, sizeof yes) != 0 ||
      connect(made.get(), peer.get(), peer.size()) != 0 ||
      getsockname(made.get(), reinterpret_cast<sockaddr*>(&storage), &size) != 0)
    return {};
  return Address::of(storage, size).with_port(0);
}

int port_of(const Descriptor& socket) {
  const Address own = own_address_of(socket);
  return own ? own.port() : 0;
}

Address peer_of(const Descriptor& socket) {
  sockaddr_storage storage{};
  socklen_t size = sizeof storage;
  if (getpeername(socket.get(), reinterpret_cast<sockaddr*>(&storage), &size) != 0) return {};
  return Address::of(storage, size);
}

bool is_connected_to_itself(const Descriptor& socket) {
  const Address peer = peer_of(socket);
  return peer && peer == own_address_of(socket);
}

void break_off(Descriptor socket) {
  const linger at_once{.l_onoff = 1, .l_linger = 0};
  setsockopt(socket.get(), SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
}

}  // namespace jarol::distributers

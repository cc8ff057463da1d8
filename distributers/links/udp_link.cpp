// The link type `udp`.
#include <stdexcept>

#include "distributers/links/announcer.h"
#include "distributers/links/packet_link.h"
#include "distributers/links/udp.h"

namespace jarol::distributers {
namespace {

struct UdpSpec : PacketLinkSpec {
  Maybe<std::string> listen, peer, announce;
};

// Beyond this machine only if the peer is there.
Address anywhere_towards(const Address& peer) {
  const bool v6 = peer && peer.family() == AF_INET6;
  if (peer && peer.is_loopback()) return Address::parse(v6 ? "[::1]:0" : "127.0.0.1:0");
  return Address::parse(v6 ? "[::]:0" : "0.0.0.0:0");
}

// Who hears of this link there, and can't answer to where it listens. All addresses of IPv6 are those of IPv4, too.
void require_same_family(const Located<std::string>& announce, const std::vector<Address>& to, const Address& listen,
                         Problems& problems) {
  if (!listen || (listen.is_any() && listen.family() == AF_INET6)) return;
  for (const Address& address : to)
    if (address.family() != listen.family())
      problems.add(announce.where, "whoever is at '" + address.text() + "' can't answer to '" + listen.text() +
                                       "', where this link listens: one is IPv4, the other IPv6");
}

std::unique_ptr<Transport> make_udp(const UdpSpec& spec, const Yaml& yaml, const std::string& subject,
                                    Problems& problems) {
  const Address peer = read_address(spec.peer, problems);
  if (!spec.listen && !spec.peer) problems.add(yaml.where, subject + " needs 'listen' or 'peer', or both");
  const Address listen = spec.listen ? read_address(spec.listen, problems) : anywhere_towards(peer);
  if (listen && peer && listen.family() != peer.family())
    problems.add(spec.peer->where, "'" + spec.peer->value + "' can't be reached from '" + spec.listen->value +
                                       "': one is IPv4, the other IPv6");
  const bool is_itself = peer == listen || (listen.is_any() && peer.is_loopback());
  if (listen && peer && is_itself && peer.port() == listen.port())
    problems.add(spec.peer->where,
                 "'" + spec.peer->value + "' is where this link listens itself; state where the other end does");
  try {
    const std::vector<Address> to = spec.announce ? Announcer::parse(spec.announce->value) : std::vector<Address>{};
    if (spec.announce) require_same_family(*spec.announce, to, listen, problems);
    return std::make_unique<UdpTransport>(listen, peer, to, spec.silence_of_peer());
  } catch (const std::invalid_argument& error) {
    problems.add(spec.announce->where, error.what());
    return nullptr;
  }
}

}  // namespace

LinkType udp_link() {
  LinkType type = packet_link<UdpSpec>(
      "udp", "datagrams, a packet each", {.silence = true, .key = true},
      {key<&UdpSpec::listen>("listen", Form::address,
                             "port to listen at, with an address where not the loopback; default: any port"),
       key<&UdpSpec::peer>(
           "peer", Form::address,
           "address and port of the other end; default: the first that speaks validly, while it is heard"),
       key<&UdpSpec::announce>("announce", Form::addresses,
                               "where to announce itself, as in 127.0.0.1:30100-30104; default: nowhere")},
      make_udp);
  type.needs_one_of = {"listen", "peer"};
  return type;
}

}  // namespace jarol::distributers

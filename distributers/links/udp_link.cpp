// The link type `udp`.
#include <algorithm>

#include "distributers/links/announcer.h"
#include "distributers/links/packet_link.h"
#include "distributers/links/udp.h"
#include "graph/text/errors.h"

namespace jarol::distributers {
namespace {

struct UdpSpec : PacketLinkSpec {
  Maybe<std::string> listen, peer, announce;
  Maybe<std::int64_t> peers;
};

constexpr std::int64_t max_peers = Ownership::max_places;

// How many at once; of what is wrong one.
std::size_t read_peers(const UdpSpec& spec, const std::string& subject, Problems& problems) {
  if (!spec.peers) return 1;
  const std::size_t before = problems.size();
  const auto& [peers, where] = *spec.peers;
  if (peers < 1 || peers > max_peers)
    problems.add(where,
                 subject + " has from 1 to " + std::to_string(max_peers) + " peers, not " + std::to_string(peers));
  if (spec.peer)
    problems.add(where, subject + " has 'peers' beside 'peer', which names the only one; leave out one of the two");
  if (spec.key)
    problems.add(where, subject + " has 'peers' beside 'key', which joins two ends; leave out one of the two");
  return problems.size() > before ? 1 : static_cast<std::size_t>(peers);
}

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
  const std::size_t peers = read_peers(spec, subject, problems);
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
    return std::make_unique<UdpTransport>(listen, peer, to, spec.silence_of_peer(), peers);
  } catch (const InputError& error) {
    problems.add(spec.announce->where, error.what());
    return nullptr;
  }
}

}  // namespace

std::string why_one_peer(const DistributerClass& distributer) {
  if (distributer.is_vehicle) return "a " + distributer.name + " is one vehicle";
  if (distributer.message_set == nullptr) return "";
  const messages::MessageSet& set = distributer.message_set();
  const auto has = [&](std::string_view name) {
    return std::any_of(set.header->fields.begin(), set.header->fields.end(),
                       [&](const messages::FieldDescriptor& field) { return field.name == name; });
  };
  if (has("src") && has("dst")) return "";
  return "messages of " + std::string(set.name) + " have no addresses, by which several could be told apart";
}

LinkType udp_link() {
  LinkType type = packet_link<UdpSpec>(
      "udp", "datagrams, a packet each", {.silence = true, .key = true},
      {key<&UdpSpec::listen>("listen", Form::address,
                             "port to listen at, with an address where not the loopback; default: any port"),
       key<&UdpSpec::peer>(
           "peer", Form::address,
           "address and port of the other end; default: the first that speaks validly, while it is heard"),
       key<&UdpSpec::peers>("peers", Form::integer,
                            "how many operators may have it at once, where messages have addresses; default 1")
           .within(1, max_peers),
       key<&UdpSpec::announce>("announce", Form::addresses,
                               "where to announce itself, as in 127.0.0.1:30100-30104; default: nowhere")},
      make_udp);
  type.needs_one_of = {"listen", "peer"};
  type.not_together = {{"peers", "peer"}, {"peers", "key"}};
  type.make_external_system = [type](const LinkRequest& request, Problems& problems) {
    const Yaml* const peers = request.yaml().find("peers");
    if (const std::string why = why_one_peer(*request.whose().distributer_class); peers != nullptr && !why.empty())
      problems.add(peers->where, request.subject() + " has 'peers', but " + why + "; leave it out");
    return make_packet_system(type, request, problems);
  };
  return type;
}

}  // namespace jarol::distributers

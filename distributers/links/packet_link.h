// Link types that carry packets by a transport, in real time, and the keys that they have in common.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "distributers/links/address.h"
#include "distributers/links/link_type.h"

namespace jarol::distributers {

/// The keys in common; a type with keys of its own derives from it.
struct PacketLinkSpec {
  Maybe<std::string> key;
  Maybe<std::int64_t> id, source;
  Maybe<Duration> silence;
  Maybe<Yaml> port;

  std::chrono::nanoseconds silence_of_peer() const;
};

/// Which a type has beside `id`, `source` and `port`.
struct CommonKeys {
  bool silence = false;  // another may take the place of its peer
  bool key = false;      // its packets can be sealed
};

/// The keys of `port`.
struct PortsSpec {
  Maybe<Yaml> in, out;
};
const std::vector<Key<PortsSpec>>& ports_keys();

/// An address; what is wrong with it is a problem of the place where it stands.
Address read_address(const Maybe<std::string>& text, Problems& problems);

/// The key in that file; what is wrong with it is a problem of the place where the path stands.
std::optional<SecretKey> read_key_file(const Located<std::string>& path, Problems& problems);

/// The link by that transport, with what the common keys say; of no transport none.
std::unique_ptr<Link> make_packet_link(std::unique_ptr<Transport> transport, const PacketLinkSpec& spec,
                                       const messages::MessageSet& set, const std::string& subject, Problems& problems);

/// As make_external_system of a LinkType that has `make_link`.
std::unique_ptr<ExternalSystem> make_packet_system(const LinkType& type, const LinkRequest& request,
                                                   Problems& problems);

/// Makes a transport of what its mapping says, which is an S; what is wrong with that goes to `problems`, and then
/// there is none. `subject` is what messages call the link.
template <class S>
using MakeTransport = std::unique_ptr<Transport> (*)(const S& spec, const Yaml& yaml, const std::string& subject,
                                                     Problems& problems);

/// A link type by a transport; S is derived from PacketLinkSpec.
template <class S>
LinkType packet_link(std::string name, std::string summary, CommonKeys common, std::vector<Key<S>> keys,
                     std::type_identity_t<MakeTransport<S>> make) {
  if (common.silence)
    keys.push_back(key_for<S, &PacketLinkSpec::silence>(
        "silence", Form::positive_duration, "of the peer, after which another may take its place; default 5 s"));
  if (common.key)
    keys.push_back(key_for<S, &PacketLinkSpec::key>(
        "key", Form::word, "file of the key that both ends have; default: none, anyone is believed"));
  keys.push_back(key_for<S, &PacketLinkSpec::id>(
      "id", Form::id, "the sender's id in what is sent, as in 0x00D1; packets to another id are dropped"));
  keys.push_back(key_for<S, &PacketLinkSpec::source>("source", Form::id,
                                                     "the sender's id in what counts, as in 0x00D1; default: any"));
  keys.push_back(key_for<S, &PacketLinkSpec::port>("port", Form::mapping, "kind and size of the link's ports")
                     .holding(ports_keys()));
  LinkType type{std::move(name), summary};
  keys = with_type_key(std::move(summary), std::move(keys));
  type.keys.assign(keys.begin(), keys.end());
  type.make_link = [name = type.name, keys, make](const Yaml& yaml, const messages::MessageSet& set,
                                                  const std::string& subject, Problems& problems) {
    const std::size_t before = problems.size();
    S spec;
    read_keys(yaml, keys, spec, subject, problems);
    return make_by_type(name, yaml.where, subject, problems, [&] {
      std::unique_ptr<Transport> transport;
      if (problems.size() == before) transport = make(spec, yaml, subject, problems);
      if (problems.size() > before) transport = nullptr;
      return make_packet_link(std::move(transport), spec, set, subject, problems);
    });
  };
  type.make_external_system = [type](const LinkRequest& request, Problems& problems) {
    return make_packet_system(type, request, problems);
  };
  return type;
}

}  // namespace jarol::distributers

#include "distributers/links/link_spec.h"

#include <stdexcept>

#include "distributers/links/announcer.h"
#include "distributers/links/serial.h"
#include "distributers/links/tcp.h"
#include "distributers/links/udp.h"
#include "graph/language/key.h"

namespace jarol {

template <>
struct Words<distributers::PortKind> {
  static std::vector<std::string> list() { return {"plain", "push"}; }
};

namespace distributers {
namespace {

struct PortSpec {
  Maybe<PortKind> kind;
  Maybe<std::int64_t> packets;
};

const std::vector<Key<PortSpec>>& port_keys() {
  static const std::vector<Key<PortSpec>> keys{
      key<&PortSpec::kind>("kind", Form::choice, "push: the newest overwrites the oldest; plain: what is full refuses"),
      key<&PortSpec::packets>("packets", Form::integer, "how many it holds; default 64"),
  };
  return keys;
}

struct PortsSpec {
  Maybe<Yaml> in, out;
};

const std::vector<Key<PortsSpec>>& ports_keys() {
  static const std::vector<Key<PortsSpec>> keys{
      key<&PortsSpec::in>("in", Form::mapping, "of packets that arrive; default push"),
      key<&PortsSpec::out>("out", Form::mapping, "of packets to send; default plain"),
  };
  return keys;
}

struct LinkSpec {
  Maybe<std::string> type, listen, peer, device, announce, key;
  Maybe<std::int64_t> baud, id, source;
  Maybe<Duration> silence;
  Maybe<Yaml> port;
};

const Key<LinkSpec> type_key = key<&LinkSpec::type>("type", Form::word, "kind of link", true);
const Key<LinkSpec> id_key = key<&LinkSpec::id>("id", Form::id, "the sender's id in what is sent, as in 0x00D1");
const Key<LinkSpec> source_key =
    key<&LinkSpec::source>("source", Form::id, "the sender's id in what counts, as in 0x00D1; default: any");
const Key<LinkSpec> key_key =
    key<&LinkSpec::key>("key", Form::word, "file of the key that both ends have; default: none, anyone is believed");
const Key<LinkSpec> silence_key = key<&LinkSpec::silence>(
    "silence", Form::positive_duration, "of the peer, after which another may take its place; default 5 s");
const Key<LinkSpec> ports_key = key<&LinkSpec::port>("port", Form::mapping, "kind and size of the link's ports");

const std::vector<Key<LinkSpec>>& udp_keys() {
  static const std::vector<Key<LinkSpec>> keys{
      type_key,
      key<&LinkSpec::listen>("listen", Form::word,
                             "port to listen at, with an address where not the loopback; default: any port"),
      key<&LinkSpec::peer>("peer", Form::word,
                           "address and port of the other end; default: whoever sent the last valid packet"),
      key<&LinkSpec::announce>("announce", Form::word,
                               "where to announce itself, as in 127.0.0.1:30100-30104; default: nowhere"),
      silence_key,
      key_key,
      id_key,
      source_key,
      ports_key,
  };
  return keys;
}

const std::vector<Key<LinkSpec>>& client_keys() {
  static const std::vector<Key<LinkSpec>> keys{
      type_key,   key<&LinkSpec::peer>("peer", Form::word, "address and port to connect to", true),
      key_key,    id_key,
      source_key, ports_key};
  return keys;
}

const std::vector<Key<LinkSpec>>& server_keys() {
  static const std::vector<Key<LinkSpec>> keys{
      type_key,
      key<&LinkSpec::listen>("listen", Form::word, "port to listen at, with an address where not the loopback", true),
      silence_key,
      key_key,
      id_key,
      source_key,
      ports_key,
  };
  return keys;
}

const std::vector<Key<LinkSpec>>& serial_keys() {
  static const std::vector<Key<LinkSpec>> keys{
      type_key,
      key<&LinkSpec::device>("device", Form::word, "the line, as in /dev/ttyS0", true),
      key<&LinkSpec::baud>("baud", Form::integer, "its rate; default 115200"),
      id_key,
      source_key,
      ports_key,
  };
  return keys;
}

// An address; what is wrong with it is a problem of the place where it stands.
Address address_of(const Maybe<std::string>& text, Problems& problems) {
  if (!text) return {};
  try {
    return Address::parse(text->value);
  } catch (const std::invalid_argument& error) {
    problems.add(text->where, error.what());
    return {};
  }
}

// Beyond this machine only if the peer is there.
Address anywhere_towards(const Address& peer) {
  const bool v6 = peer && peer.family() == AF_INET6;
  if (peer && peer.is_loopback()) return Address::parse(v6 ? "[::1]:0" : "127.0.0.1:0");
  return Address::parse(v6 ? "[::]:0" : "0.0.0.0:0");
}

std::chrono::nanoseconds silence_of(const LinkSpec& spec) {
  return spec.silence ? spec.silence->value : std::chrono::nanoseconds(Ownership::default_silence);
}

std::unique_ptr<Transport> make_udp(const LinkSpec& spec, const Yaml& yaml, const std::string& subject,
                                    Problems& problems) {
  const Address peer = address_of(spec.peer, problems);
  if (!spec.listen && !spec.peer) problems.add(yaml.where, subject + " needs 'listen' or 'peer', or both");
  const Address listen = spec.listen ? address_of(spec.listen, problems) : anywhere_towards(peer);
  if (listen && peer && listen.family() != peer.family())
    problems.add(spec.peer->where, "'" + spec.peer->value + "' can't be reached from '" + spec.listen->value +
                                       "': one is IPv4, the other IPv6");
  try {
    // all who may look for it are told the same: where the first of them sees it
    return std::make_unique<UdpTransport>(
        listen, peer, spec.announce ? Announcer::parse(spec.announce->value).front() : Address{}, silence_of(spec));
  } catch (const std::invalid_argument& error) {
    problems.add(spec.announce->where, error.what());
    return nullptr;
  }
}

std::unique_ptr<Transport> make_transport(const Yaml& yaml, LinkSpec& spec, const std::string& subject,
                                          Problems& problems) {
  const std::string type = yaml.find("type")->text;
  const std::size_t before = problems.size();
  if (type == "udp") {
    read_keys(yaml, udp_keys(), spec, subject, problems);
    return problems.size() > before ? nullptr : make_udp(spec, yaml, subject, problems);
  }
  if (type == "tcp_client") {
    read_keys(yaml, client_keys(), spec, subject, problems);
    return problems.size() > before ? nullptr : std::make_unique<TcpClient>(address_of(spec.peer, problems));
  }
  if (type == "tcp_server") {
    read_keys(yaml, server_keys(), spec, subject, problems);
    return problems.size() > before ? nullptr
                                    : std::make_unique<TcpServer>(address_of(spec.listen, problems), silence_of(spec));
  }
  read_keys(yaml, serial_keys(), spec, subject, problems);
  if (problems.size() > before) return nullptr;
  try {
    constexpr std::int64_t usual = 115200;
    return std::make_unique<SerialTransport>(spec.device->value,
                                             static_cast<int>(spec.baud ? spec.baud->value : usual));
  } catch (const std::invalid_argument& error) {
    problems.add(spec.baud ? spec.baud->where : yaml.where, error.what());
    return nullptr;
  }
}

void read_port(const Maybe<Yaml>& yaml, PortOptions& to, const std::string& subject, Problems& problems) {
  if (!yaml) return;
  PortSpec spec;
  read_keys(yaml->value, port_keys(), spec, subject, problems);
  if (spec.kind) to.kind = spec.kind->value;
  if (!spec.packets) return;
  constexpr std::int64_t most = 4096;
  if (spec.packets->value < 1 || spec.packets->value > most)
    problems.add(spec.packets->where, subject + " holds from 1 to " + std::to_string(most) + " packets, not " +
                                          std::to_string(spec.packets->value));
  else
    to.packets = static_cast<std::size_t>(spec.packets->value);
}

}  // namespace

std::optional<SecretKey> key_of(const Located<std::string>& path, Problems& problems) {
  try {
    return read_key(path.value);
  } catch (const std::invalid_argument& error) {
    problems.add(path.where, error.what());
    return std::nullopt;
  }
}

const std::vector<std::string>& link_types() {
  static const std::vector<std::string> types{"udp", "tcp_client", "tcp_server", "serial"};
  return types;
}

std::unique_ptr<Link> make_link(const Yaml& yaml, const messages::MessageSet& set, const std::string& subject,
                                Problems& problems) {
  const std::size_t before = problems.size();
  LinkSpec spec;
  std::unique_ptr<Transport> transport = make_transport(yaml, spec, subject, problems);
  LinkOptions options;
  options.silence = silence_of(spec);
  if (spec.key) options.key = key_of(*spec.key, problems);
  if (spec.port) {
    PortsSpec ports;
    read_keys(spec.port->value, ports_keys(), ports, "port of the " + subject, problems);
    read_port(ports.in, options.input, "port 'in' of the " + subject, problems);
    read_port(ports.out, options.output, "port 'out' of the " + subject, problems);
  }
  if (problems.size() > before) return nullptr;
  if (spec.id) options.header.emplace_back("src", static_cast<std::uint64_t>(spec.id->value));
  const Maybe<std::int64_t>& last = spec.source ? spec.source : spec.id;
  if (spec.source) options.accept.emplace_back("src", static_cast<std::uint64_t>(spec.source->value));
  try {
    return std::make_unique<Link>(std::move(transport), set, options);
  } catch (const std::invalid_argument& error) {
    problems.add(last->where, subject + ": " + error.what());
    return nullptr;
  }
}

std::unique_ptr<Link> make_announcer(const Yaml& yaml, const messages::MessageSet& set, Problems& problems) {
  const Yaml *to = yaml.find("announce"), *id = yaml.find("id");
  if (to == nullptr) return nullptr;
  LinkOptions options;
  std::int64_t sender = 0;
  Problems told;  // what is wrong with the link's keys was reported with the link
  if (id != nullptr && detail::read_id(*id, sender, "id", told))
    options.header.emplace_back("src", static_cast<std::uint64_t>(sender));
  try {
    return std::make_unique<Link>(std::make_unique<Announcer>(Announcer::parse(to->text)), set, options);
  } catch (const std::invalid_argument& error) {
    problems.add(to->where, error.what());
    return nullptr;
  }
}

}  // namespace distributers
}  // namespace jarol

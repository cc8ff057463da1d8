#include "distributers/links/packet_link.h"

#include "distributers/interfaces/any_distributer.h"
#include "distributers/links/linked.h"
#include "graph/text/errors.h"

namespace jarol {

template <>
struct Words<distributers::PortKind> {
  static std::vector<std::string> list() { return {"plain", "push"}; }
};

namespace distributers {
namespace {

constexpr std::int64_t max_packets = 4096;

struct PortSpec {
  Maybe<PortKind> kind;
  Maybe<std::int64_t> packets;
};

const std::vector<Key<PortSpec>>& port_keys() {
  static const std::vector<Key<PortSpec>> keys{
      key<&PortSpec::kind>("kind", Form::choice, "push: the newest overwrites the oldest; plain: what is full refuses"),
      key<&PortSpec::packets>("packets", Form::integer, "how many it holds; default 256 in, 64 out")
          .within(1, max_packets),
  };
  return keys;
}

void read_port(const Maybe<Yaml>& yaml, PortOptions& to, const std::string& subject, Problems& problems) {
  if (!yaml) return;
  PortSpec spec;
  read_keys(yaml->value, port_keys(), spec, subject, problems);
  if (spec.kind) to.kind = spec.kind->value;
  if (!spec.packets) return;
  if (spec.packets->value < 1 || spec.packets->value > max_packets)
    problems.add(spec.packets->where, subject + " holds from 1 to " + std::to_string(max_packets) + " packets, not " +
                                          std::to_string(spec.packets->value));
  else
    to.packets = static_cast<std::size_t>(spec.packets->value);
}

}  // namespace

std::chrono::nanoseconds PacketLinkSpec::silence_of_peer() const {
  return silence ? silence->value : std::chrono::nanoseconds(Ownership::default_silence);
}

const std::vector<Key<PortsSpec>>& ports_keys() {
  static const std::vector<Key<PortsSpec>> keys{
      key<&PortsSpec::in>("in", Form::mapping, "of packets that arrive; default push").holding(port_keys()),
      key<&PortsSpec::out>("out", Form::mapping, "of packets to send; default plain").holding(port_keys()),
  };
  return keys;
}

Address read_address(const Maybe<std::string>& text, Problems& problems) {
  if (!text) return {};
  try {
    return Address::parse(text->value);
  } catch (const InputError& error) {
    problems.add(text->where, error.what());
    return {};
  }
}

std::optional<SecretKey> read_key_file(const Located<std::string>& path, Problems& problems) {
  try {
    return read_key(path.value);
  } catch (const InputError& error) {
    problems.add(path.where, error.what());
    return std::nullopt;
  }
}

std::unique_ptr<Link> make_packet_link(std::unique_ptr<Transport> transport, const PacketLinkSpec& spec,
                                       const messages::MessageSet& set, const std::string& subject,
                                       Problems& problems) {
  const std::size_t before = problems.size();
  LinkOptions options;
  options.silence = spec.silence_of_peer();
  if (spec.key) options.key = read_key_file(*spec.key, problems);
  if (spec.port) {
    PortsSpec ports;
    read_keys(spec.port->value, ports_keys(), ports, "port of the " + subject, problems);
    read_port(ports.in, options.input, "port 'in' of the " + subject, problems);
    read_port(ports.out, options.output, "port 'out' of the " + subject, problems);
  }
  if (transport == nullptr || problems.size() > before) return nullptr;
  if (spec.id) options.header.emplace_back("src", static_cast<std::uint64_t>(spec.id->value));
  const Maybe<std::int64_t>& last = spec.source ? spec.source : spec.id;
  if (spec.source) options.accept.emplace_back("src", static_cast<std::uint64_t>(spec.source->value));
  try {
    return std::make_unique<Link>(std::move(transport), set, options);
  } catch (const InputError& error) {
    if (!last) throw;  // the transport's own
    problems.add(last->where, subject + ": " + error.what());
    return nullptr;
  }
}

std::unique_ptr<ExternalSystem> make_packet_system(const LinkType& type, const LinkRequest& request,
                                                   Problems& problems) {
  try {
    auto distributer = request.make_distributer();
    const messages::MessageSet& set = distributer->message_set();
    auto link = type.make_link(request.yaml(), set, request.subject(), problems);
    if (!link) return nullptr;
    return std::make_unique<LinkedSystem>(std::move(link), std::move(distributer));
  } catch (const InputError& error) {
    problems.add(request.yaml().where, "distributer '" + request.whose().name + "': " + error.what());
    return nullptr;
  }
}

}  // namespace distributers
}  // namespace jarol

#include "distributers/distributers.h"

#include "distributers/interfaces/typed.h"
#include "distributers/javiator/operator.h"
#include "distributers/javiator/vehicle.h"
#include "distributers/lauv/operator.h"
#include "distributers/lauv/vehicle.h"
#include "distributers/links/console.h"
#include "distributers/links/lockstep.h"
#include "distributers/links/script.h"
#include "distributers/links/serial.h"
#include "distributers/links/simulation.h"
#include "distributers/links/tcp.h"
#include "distributers/links/udp.h"
#include "graph/values/seed.h"

namespace jarol::distributers {
std::vector<std::string> links_of(const DistributerClass& distributer, const NamedList<LinkType>& all) {
  std::vector<std::string> names;
  for (const LinkType& type : all.entries()) {
    if (distributer.is_vehicle ? type.for_operators : type.for_vehicles) continue;
    if (type.without_messages || distributer.make != nullptr) names.push_back(type.name);
  }
  return names;
}

void add_distributers(Registry& registry) {
  registry.add(distributer_class<JaviatorVehicle>());
  registry.add(distributer_class<JaviatorOperator>());
  registry.add(distributer_class<LauvVehicle>());
  registry.add(distributer_class<LauvOperator>());
}

void add_links(NamedList<LinkType>& links) {
  for (auto* const type : {simulation_link, lockstep_link, script_link, console_link, udp_link, tcp_client_link,
                           tcp_server_link, serial_link})
    links.add(type());
}

std::vector<std::unique_ptr<ExternalSystem>> make_external_systems(const Graph& graph, const Registries& known,
                                                                   std::uint64_t seed, Problems& problems,
                                                                   std::vector<std::shared_ptr<const Source>>* files) {
  return make_external_systems(graph, graph.distributers, known, seed, problems, files);
}

std::vector<std::unique_ptr<ExternalSystem>> make_external_systems(const Graph& graph,
                                                                   const std::vector<Distributer>& distributers,
                                                                   const Registries& known, std::uint64_t seed,
                                                                   Problems& problems,
                                                                   std::vector<std::shared_ptr<const Source>>* files) {
  std::vector<std::unique_ptr<ExternalSystem>> all;
  for (std::size_t i = 0; i < distributers.size(); ++i) {
    const Distributer& distributer = distributers[i];
    all.emplace_back();
    if (distributer.distributer_class == nullptr || distributer.link.kind != Yaml::Kind::mapping) continue;
    const LinkRequest request{graph, distributer, i, known.vehicles, spread_seed(seed, distributer.name), files};
    const std::vector<std::string> links = links_of(*distributer.distributer_class, known.links);
    const std::string can = "; a " + distributer.distributer_class->name + " can have: " + list_of(links);
    const Yaml* type = distributer.link.find("type");
    if (type == nullptr)
      problems.add(distributer.link.where, request.subject() + " lacks the key 'type'" + can);
    else if (std::find(links.begin(), links.end(), type->text) == links.end())
      problems.add(type->where,
                   request.subject() + " has type '" + type->text + "'" + did_you_mean(type->text, links) + can);
    else
      all.back() = known.links.find(type->text)->make_external_system(request, problems);
  }
  return all;
}

std::vector<std::vector<std::byte>> safe_packets(const Graph& graph, std::size_t distributer, Link& link) {
  struct Encoder : messages::Receiver {
    explicit Encoder(Link& by) : link(by) {}
    void receive(messages::MessageRef message) override {
      const std::span<const std::byte> packet = link.encode(message);
      packets.emplace_back(packet.begin(), packet.end());
    }
    Link& link;
    std::vector<std::vector<std::byte>> packets;
  } encoder(link);
  const Distributer& of = graph.distributers[distributer];
  const auto made = of.distributer_class->make(of.parameters.data());
  made->take_over();
  for (const Communicator& c : graph.communicators)
    if (c.distributer == distributer && c.safe) made->hand_over(c.channel, c.safe->data(), encoder);
  return std::move(encoder.packets);
}

}  // namespace jarol::distributers

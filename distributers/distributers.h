// What is built in, and the way from a valid graph to its external systems.
#pragma once

#include <memory>
#include <vector>

#include "distributers/registries.h"

namespace jarol::distributers {

/// Adds every distributer of this folder.
void add_distributers(Registry& registry);

/// Adds every link type of this folder.
void add_links(NamedList<LinkType>& links);

/// The names of the link types that a distributer can have.
std::vector<std::string> links_of(const DistributerClass& distributer, const NamedList<LinkType>& all);

/// The external system of each distributer of the graph, in its order, linked as the file says; each gets its share of
/// the seed by the distributer's name. What is wrong goes to `problems`, and a null stands in the place. `files` gets
/// what the links name and is read, if it is not null.
std::vector<std::unique_ptr<ExternalSystem>> make_external_systems(
    const Graph& graph, const Registries& known, std::uint64_t seed, Problems& problems,
    std::vector<std::shared_ptr<const Source>>* files = nullptr);

/// The same with the distributers as a run has them: other parameters and links than in the graph.
std::vector<std::unique_ptr<ExternalSystem>> make_external_systems(
    const Graph& graph, const std::vector<Distributer>& distributers, const Registries& known, std::uint64_t seed,
    Problems& problems, std::vector<std::shared_ptr<const Source>>* files = nullptr);

/// The packets that bring the external system of that distributer to rest, whatever it was sent before: its `out`s with
/// a `safe` hand that over. By the translator of its link, which is not connected yet.
std::vector<std::vector<std::byte>> safe_packets(const Graph& graph, std::size_t distributer, Link& link);

}  // namespace jarol::distributers

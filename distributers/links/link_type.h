// What graphs may name as the `type` of a link: its keys, and what makes it.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "distributers/interfaces/vehicle.h"
#include "distributers/links/link.h"
#include "graph/language/key.h"
#include "graph/model/graph.h"
#include "graph/named_list.h"
#include "runtime/external_system.h"

namespace jarol::distributers {

class AnyDistributer;

/// A distributer of a graph that needs its link.
struct LinkRequest {
  const Graph& graph;
  const Distributer& of;                              // the graph's, or as a run has it
  std::size_t distributer = 0;                        // in the graph
  const NamedList<vehicles::VehicleClass>& vehicles;  // that can be simulated
  std::uint64_t seed = 0;                             // this distributer's share of the run's
  std::vector<std::shared_ptr<const Source>>* files;  // gets what it reads; may be null

  const Distributer& whose() const { return of; }
  const Yaml& yaml() const { return whose().link; }
  /// As messages call it: "link of distributer 'dune'".
  std::string subject() const;
  /// The distributer's code. Throws InputError if there can be none with its parameters, whatever its
  /// constructor throws.
  std::unique_ptr<AnyDistributer> make_distributer() const;
  /// A file that the link names, whose path is relative to the graph's; null: it can't be read, which is reported.
  std::shared_ptr<const Source> read_beside(const Located<std::string>& path, Problems& problems) const;
};

/// What is not on the grid of a vehicle: periods and offsets of what touches it have to be.
std::vector<Problem> off_grid(const Graph& graph, std::size_t distributer, Duration grid);

struct LinkType {
  std::string name;
  std::string summary;
  std::vector<KeyDescription> keys{};

  /// Keys of which it needs one at least.
  std::vector<std::string> needs_one_of{};
  /// Keys of which it can't have both.
  std::vector<std::pair<std::string, std::string>> not_together{};
  /// Joins vehicles only, or operators.
  bool for_vehicles = false, for_operators = false;
  /// Carries no messages, so that the distributer needs no code.
  bool without_messages = false;
  /// Plays a mission from a file, and joins nothing else.
  bool is_mission = false;

  /// What is wrong goes to `problems`, and then there is no external system.
  std::function<std::unique_ptr<ExternalSystem>(const LinkRequest& request, Problems& problems)> make_external_system{};

  /// The link alone, for packets of that set; `subject` is what messages call it. Of those types that carry packets in
  /// real time; others have none.
  std::function<std::unique_ptr<Link>(const Yaml& yaml, const messages::MessageSet& set, const std::string& subject,
                                      Problems& problems)>
      make_link{};
};

/// The key `type`, which every link has, before those of its own.
template <class S>
std::vector<Key<S>> with_type_key(std::string text, std::vector<Key<S>> keys) {
  keys.insert(keys.begin(), key_read_elsewhere<S>("type", Form::word, std::move(text), true));
  return keys;
}

/// In a catch block around the code of a link type, which may be a plugin's: what has no type of its own becomes a
/// problem of that place; the rest is thrown again.
void report_thrown(const std::string& type, const Location& where, const std::string& subject, Problems& problems);

/// What `make` makes by the code of a link type; what that throws is reported, and then there is none.
template <class Make>
std::invoke_result_t<Make> make_by_type(const std::string& type, const Location& where, const std::string& subject,
                                        Problems& problems, const Make& make) {
  try {
    return make();
  } catch (...) { report_thrown(type, where, subject, problems); }
  return nullptr;
}

/// A link type whose keys are read into an S; `make` gets it with what could be read.
template <class S, class Make>
LinkType link_type(std::string name, std::string summary, std::vector<Key<S>> own_keys, Make make) {
  LinkType type{std::move(name), summary};
  const std::vector<Key<S>> keys = with_type_key(std::move(summary), std::move(own_keys));
  type.keys.assign(keys.begin(), keys.end());
  type.make_external_system = [name = type.name, keys, make](const LinkRequest& request,
                                                             Problems& problems) -> std::unique_ptr<ExternalSystem> {
    S spec;
    read_keys(request.yaml(), keys, spec, request.subject(), problems);
    return make_by_type(name, request.yaml().where, request.subject(), problems,
                        [&]() -> std::unique_ptr<ExternalSystem> { return make(spec, request, problems); });
  };
  return type;
}

}  // namespace jarol::distributers

// The link type `lockstep`.
#include "distributers/links/lockstep.h"
#include "distributers/links/packet_link.h"
#include "graph/text/errors.h"

namespace jarol::distributers {
namespace {

struct LockstepSpec {
  Maybe<std::string> peer, key;
};

std::unique_ptr<ExternalSystem> make_lockstep_system(const LockstepSpec& spec, const LinkRequest& request,
                                                     Problems& problems) {
  if (!spec.peer) return nullptr;
  LockstepOptions options;
  if (spec.key && !(options.key = read_key_file(*spec.key, problems))) return nullptr;
  try {
    return std::make_unique<LockstepSystem>(
        Address::parse(spec.peer->value), request.seed, request.make_distributer(),
        [&graph = request.graph, index = request.distributer](Duration grid) {
          const std::vector<Problem> wrong = off_grid(graph, index, grid);
          return wrong.empty() ? std::string() : wrong.front().text;
        },
        std::move(options));
  } catch (const InputError& error) {
    problems.add(spec.peer->where, error.what());
    return nullptr;
  }
}

}  // namespace

LinkType lockstep_link() {
  LinkType type = link_type<LockstepSpec>(
      "lockstep", "a vehicle in another process, on the logical clock",
      {key<&LockstepSpec::peer>("peer", Form::address, "address and port where it listens", true),
       key<&LockstepSpec::key>("key", Form::word, "file of the key that both ends have; default: none")},
      make_lockstep_system);
  type.for_vehicles = true;
  return type;
}

}  // namespace jarol::distributers

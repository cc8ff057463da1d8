// The first message that a page gets: all that it needs to know of a run, from the descriptions of its graph.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "graph/language/load.h"
#include "graph/model/graph.h"
#include "tools/console/flow.h"

namespace jarol::tools::console {

/// What the run was begun with: a page gives it to the next one, with other parameters.
struct Given {
  std::string file;  // the graph's
  Overrides overrides{};
  std::uint64_t seed = 0;
};

struct Described {
  const Graph& graph;
  std::string file;                       // as the user called it
  std::string clock;                      // virtual, real or recorded
  Duration until{};                       // the greatest there is: until it is ended
  std::vector<const Type*> true_types{};  // per distributer, null: nothing is known of a vehicle
  std::optional<Flow> flow{};             // of what a vehicle moves in
  std::optional<Given> given{};           // nothing: that is not known
};

nlohmann::ordered_json describe_run(const Described& run);

}  // namespace jarol::tools::console

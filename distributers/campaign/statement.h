// What a campaign is: what the graph's file says of it, and what its user adds or puts in its place.
#pragma once

#include "distributers/campaign/graphs.h"

namespace jarol::campaign {

struct Wishes {
  std::vector<std::string> vary{};  // "path=0.3..0.6"
  std::optional<std::int64_t> runs{};
  std::optional<Sampling> sampling{};
  std::optional<Duration> length{};
};

/// Throws SpecError: of a variation with a value that no run can have, too.
Campaign state_campaign(Graphs& graphs, const Wishes& wishes);

/// A key and a text for each thing that the results depend on: who resumes a campaign needs the same.
using Identity = std::vector<std::pair<std::string, std::string>>;
/// `program`: of the next; `files`: what was read for it, beside plugins.
Identity identity_of(const GraphSource& of, const Graphs& graphs, const Campaign& campaign, std::uint64_t seed,
                     const Identity& program, const SourceSet::Sources& files = {});
/// Of this process as it has begun, before it loads more: its version, and what the linker calls this build of it and
/// of each library that it is linked with.
Identity identity_of_program(const std::string& version);

}  // namespace jarol::campaign

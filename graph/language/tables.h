// The tables of the graph language, one per kind of mapping; the pages of specs/ say the same to people.
#pragma once

#include "graph/language/key.h"

namespace jarol {

/// Of a platform.
inline constexpr std::int64_t max_cores = 1024;

const std::vector<Key<GraphSpec>>& graph_keys();
/// Without the names of grammars, which registries have.
const std::vector<Key<TimingSpec>>& timing_keys();
/// With these.
std::vector<Key<TimingSpec>> timing_keys(const std::vector<std::string>& grammars);
const std::vector<Key<DistributerSpec>>& distributer_keys();
const std::vector<Key<CommunicatorSpec>>& communicator_keys();
const std::vector<Key<TaskSpec>>& task_keys();
const std::vector<Key<ChainSpec>>& chain_keys();
/// Without the names of policies, which registries have.
const std::vector<Key<PlatformSpec>>& platform_keys();
/// With these.
std::vector<Key<PlatformSpec>> platform_keys(const std::vector<std::string>& policies);
const std::vector<Key<AtEndSpec>>& at_end_keys();
const std::vector<Key<CampaignSpec>>& campaign_keys();

}  // namespace jarol

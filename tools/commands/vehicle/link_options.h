// The options that say more about the link of `jarol vehicle`: the keys of link types, as these are registered.
#pragma once

#include <string>
#include <vector>

#include "distributers/links/link_type.h"
#include "graph/named_list.h"

namespace jarol::tools {

/// A key, and what it means, with the types that have it.
struct LinkOption {
  std::string key, text;
};

/// Of the types that carry packets in real time: the keys that one word can give, each once.
std::vector<LinkOption> link_options(const NamedList<distributers::LinkType>& types);

}  // namespace jarol::tools

// The members of a described struct at every depth, for lists of what it has.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "graph/values/type.h"

namespace jarol::tools {

struct Member {
  std::string path;  // "reckoning.water.density"
  const TypeField* field = nullptr;
  std::size_t offset = 0;  // from the start of the outermost struct
  bool has_members = false;
};

enum class Arrays {
  whole,
  by_element,  // arrays of structs have the members of each: "beacons.0.north"
};

/// Depth first: each struct comes before its members.
std::vector<Member> members_of(const Type& type, Arrays arrays);

}  // namespace jarol::tools

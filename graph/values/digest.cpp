#include "graph/values/digest.h"

#include <xxhash.h>

namespace jarol::digest {

std::uint64_t name_hash(std::string_view name) { return XXH64(name.data(), name.size(), 0); }

}  // namespace jarol::digest

// A value of any type as one run of bytes: flat parts as they lie in memory, a sequence or string after its length.
#pragma once

#include <cstddef>

#include "graph/values/type.h"

namespace jarol {

/// Bytes that `pack` writes.
std::size_t packed_size(const Type& type, const void* value);

/// Returns the first byte after what was written.
std::byte* pack(const Type& type, const void* value, std::byte* to);

/// Reads what `pack` of an equal type wrote into a value that exists; returns the first byte after it.
const std::byte* unpack(const Type& type, const std::byte* from, void* value);

}  // namespace jarol

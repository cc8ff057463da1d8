// A value of any type as one run of bytes: flat parts as they lie in memory, a sequence or string after its length.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "graph/values/type.h"

namespace jarol {

/// Bytes that `pack` writes.
std::size_t packed_size(const Type& type, const void* value);

/// Returns the first byte after what was written.
std::byte* pack(const Type& type, const void* value, std::byte* to);

/// What is wrong with bytes that come from outside, as in "has 7 where true or false stand", or nothing: they are what
/// `pack` writes of some value of the type, and may be unpacked.
std::string wrong_packed(const Type& type, std::span<const std::byte> packed);
/// The same of bytes that begin with such a value, and how many are of it.
std::string wrong_packed_begin(const Type& type, std::span<const std::byte> packed, std::size_t& size);

/// Reads what `pack` of an equal type wrote into a value that exists; returns the first byte after it.
const std::byte* unpack(const Type& type, const std::byte* from, void* value);

}  // namespace jarol

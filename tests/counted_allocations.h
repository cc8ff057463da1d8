// The global allocator of a test program that links counted_allocations.cpp.
#pragma once

#include <cstdint>

namespace jarol::tests {

/// How often memory has been asked for so far.
std::uint64_t allocations();
/// The same of the calling thread alone.
std::uint64_t allocations_of_this_thread();

}  // namespace jarol::tests

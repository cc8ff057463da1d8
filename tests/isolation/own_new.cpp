// A task that asks for memory by an operator that its plugin has defined: the one of the C++ library is called.
#include <new>
#include <vector>

#include "tests/isolation/task.h"

void* operator new(std::size_t) { throw std::bad_alloc(); }

namespace {

// offends: the global allocator: operator new: AsksForMemory::run...
TASK(AsksForMemory, {
  const std::vector<double> all(static_cast<std::size_t>(in.in) + 1, 1.0);
  out.out = all.back() + static_cast<double>(reinterpret_cast<std::uintptr_t>(all.data()) % 4096);
})

}  // namespace

JAROL_PLUGIN(AsksForMemory)

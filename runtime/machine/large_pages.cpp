#include "runtime/machine/large_pages.h"

#include <sys/mman.h>

#include <algorithm>
#include <new>

namespace jarol {
namespace {

std::align_val_t alignment_of(std::size_t bytes, std::size_t alignment) {
  return std::align_val_t{bytes < large_page ? alignment : std::max(alignment, large_page)};
}

}  // namespace

// Where the system has none it is as good without.
void* take_large(std::size_t bytes, std::size_t alignment) {
  void* const memory = ::operator new(bytes, alignment_of(bytes, alignment));
  if (bytes >= large_page) ::madvise(memory, bytes - bytes % large_page, MADV_HUGEPAGE);
  return memory;
}

void give_back_large(void* memory, std::size_t bytes, std::size_t alignment) noexcept {
  ::operator delete(memory, alignment_of(bytes, alignment));
}

}  // namespace jarol

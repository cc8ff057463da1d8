// The values of a private heap in an archive: each with its place, so that the heap goes on as it would have.
#pragma once

#include <memory_resource>
#include <vector>

#include "graph/values/archive.h"
#include "graph/values/heap.h"
#include "graph/values/type.h"

namespace jarol {

class HeapArchive {
 public:
  /// Begins with the heap's books. Restoring, all values that were in the heap are forgotten.
  HeapArchive(Archive& archive, PrivateHeap& heap);

  /// Each value whose parts of changing size live in the heap.
  void value(const Type& type, void* value);
  /// After the last one. Throws ArchiveError where two values have the same place.
  void finish();

 private:
  void deep(const Type& type, std::byte* value);
  void elements_of(const Type& type, void* value);

  Archive& archive_;
  PrivateHeap& heap_;
  std::vector<PrivateHeap::Block> blocks_;              // that are taken, and that are free
  std::pmr::monotonic_buffer_resource forgotten_{256};  // for what default values begin with
};

}  // namespace jarol

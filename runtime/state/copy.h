// How values get from an output to its readers.
#pragma once

#include <cstring>

#include "graph/values/heap.h"
#include "runtime/state/actions.h"

namespace jarol {

/// An input that does not fit its reader's heap is lost until one that does comes.
[[gnu::noinline]] inline void copy_deep(const Copy& c) {
  const auto& deep = *static_cast<const DeepCopy*>(c.from);
  try {
    deep.type->assign(c.to, deep.from);
    if (deep.input != nullptr) deep.input->lost = false;
  } catch (const HeapExhausted& error) {
    if (deep.input == nullptr) throw;
    deep.input->lost = true;
    keep_text(*deep.input, error.what());
  }
}

/// Copies of the common sizes are a few moves; the compiler can't know sizes that come from a graph.
[[gnu::always_inline]] inline void transfer(const Copy& c) {
  if (c.size == 64) {
    std::memcpy(c.to, c.from, 64);
    return;
  }
  switch (c.size) {
    case 0: return copy_deep(c);
    case 8: std::memcpy(c.to, c.from, 8); return;
    case 16: std::memcpy(c.to, c.from, 16); return;
    case 32: std::memcpy(c.to, c.from, 32); return;
    default: std::memcpy(c.to, c.from, c.size);
  }
}

}  // namespace jarol

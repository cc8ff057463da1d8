// How values get from an output to its readers.
#pragma once

#include <cstring>

#include "graph/values/heap.h"
#include "runtime/machine/copy_fresh.h"
#include "runtime/machine/wide.h"
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

template <bool AtOnce, std::size_t Bytes>
[[gnu::always_inline]] inline void copy_bytes(const Copy& c) {
  if (AtOnce && c.read_next)
    copy_fresh<Bytes>(c.to, c.from);
  else
    std::memcpy(c.to, c.from, Bytes);
}

/// Copies of the common sizes are a few moves; the compiler can't know sizes that come from a graph. `AtOnce`: as soon
/// as the value is made.
template <bool AtOnce = false>
[[gnu::always_inline]] inline void transfer(const Copy& c) {
  if (c.size == 64) {
    copy_bytes<AtOnce, 64>(c);
    return;
  }
  switch (c.size) {
    case 0: return copy_deep(c);
    case 8: std::memcpy(c.to, c.from, 8); return;
    case 16: copy_bytes<AtOnce, 16>(c); return;
    case 32: copy_bytes<AtOnce, 32>(c); return;
    default: std::memcpy(c.to, c.from, c.size);
  }
}

/// The same for many.
void transfer_all(const ShortRange<Copy>& copies, bool wide = has_wide_vectors);

}  // namespace jarol

// What is done when outputs become visible: copied to their readers, counted in the digest, recorded.
#pragma once

#include "graph/values/digest.h"
#include "runtime/record/recorder.h"
#include "runtime/state/copy.h"

namespace jarol {

/// Copies to all readers; returns the digest's part of the publications, if asked for.
template <bool Digest>
[[gnu::always_inline]] inline std::uint64_t make_visible(const Publish& what, std::uint64_t instant_term) {
  std::uint64_t digest = 0;
  for (const Copy& c : what.copies) transfer(c);
  if constexpr (Digest)
    for (const Publication& p : what.publications)
      digest += digest::publication(p.name_hash, instant_term, p.hash_words(p.value));
  return digest;
}

inline void record(Recorder& recorder, const Publish& what, std::int64_t instant) {
  for (const Publication& p : what.publications) {
    if (p.size > 0) [[likely]] {
      recorder.append(instant, p.output, p.value, p.size);
    } else {
      recorder.append_deep(instant, p.output, p.value);
    }
  }
}

inline void record(Recorder& recorder, std::uint32_t output, const Type& type, const void* value,
                   std::int64_t instant) {
  if (type.is_deep()) {
    recorder.append_deep(instant, output, value);
  } else {
    recorder.append(instant, output, value, static_cast<std::uint32_t>(type.size));
  }
}

}  // namespace jarol

// What is done when outputs become visible: copied to their readers, counted in the digest, recorded.
#pragma once

#include "graph/values/digest.h"
#include "runtime/record/recorder.h"
#include "runtime/run/now.h"
#include "runtime/state/copy.h"

namespace jarol {

/// Copies to all readers, a few of them `AtOnce`; returns the digest's part of the publications, if asked for.
template <bool Digest, bool AtOnce = false>
[[gnu::always_inline]] inline std::uint64_t make_visible(const Publish& what, std::uint64_t digest_term) {
  constexpr std::uint32_t many = 8;  // fewer of them cost less than a call
  std::uint64_t digest = 0;
  // before the copies, which wait for values just made to reach the cache where they are wider than what was stored
  if constexpr (Digest)
    for (const Publication& p : what.publications)
      digest += digest::publication(p.name_hash, digest_term, p.hash_words(p.value));
  if (what.copies.count < many) [[likely]] {
    for (const Copy& c : what.copies) transfer<AtOnce && !Digest>(c);
  } else {
    transfer_all(what.copies);
  }
  return digest;
}

inline void record(Recorder& recorder, const Publish& what, Duration instant) {
  for (const Publication& p : what.publications) {
    if (p.size > 0) [[likely]] {
      recorder.append(instant, p.output, p.value, p.size);
    } else {
      recorder.append_deep(instant, p.output, p.value);
    }
  }
}

inline void record(Recorder& recorder, std::uint32_t output, const Type& type, const void* value, Duration instant) {
  if (type.is_deep()) {
    recorder.append_deep(instant, output, value);
  } else {
    recorder.append(instant, output, value, static_cast<std::uint32_t>(type.size));
  }
}

/// Publishes for one run, on one thread.
class Publisher {
 public:
  /// `digest` is summed up there if asked for; the recorder may be null.
  Publisher(bool with_digest, std::uint64_t& digest, Recorder* recorder)
      : with_digest_(with_digest), digest_(digest), recorder_(recorder) {}

  bool with_digest() const { return with_digest_; }
  Recorder* recorder() const { return recorder_; }

  Now at(Duration instant, std::span<const std::uint32_t> due = {}) const {
    return {instant, with_digest_ ? digest::instant_term(instant.count()) : 0, due};
  }

  void publish(const Publish& what, const Now& now) {
    digest_ += with_digest_ ? make_visible<true>(what, now.digest_term) : make_visible<false>(what, 0);
    if (recorder_ != nullptr) jarol::record(*recorder_, what, now.instant);
  }

  /// Shows those who look on what is no publication.
  void show(const RunEvent& event) {
    if (recorder_ != nullptr) recorder_->append_event(event);
  }

  /// Of what others have made visible: its part of the digest, and that it is recorded.
  void add_to_digest(std::uint64_t part) { digest_ += part; }
  void record(const Publish& what, const Now& now) {
    if (recorder_ != nullptr) jarol::record(*recorder_, what, now.instant);
  }

 private:
  const bool with_digest_;
  std::uint64_t& digest_;
  Recorder* const recorder_;
};

}  // namespace jarol

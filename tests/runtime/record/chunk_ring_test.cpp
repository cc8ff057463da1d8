#include "runtime/record/chunk_ring.h"

#include <doctest/doctest.h>

using namespace jarol;

TEST_SUITE("runtime/chunk_ring") {
  TEST_CASE("of large chunks no more wait than the queue may have, however few they are") {
    ChunkRing ring([] { return std::make_unique<mcap::Chunk>(); });
    const auto fill = [&](std::size_t bytes) {
      ring.filling().add_message(1, 0, {}, bytes);
      ring.filling().seal();
      ring.next();
    };
    fill(ChunkQueue::max_bytes + 1);
    CHECK(!ring.has_room());
    (*ring.full())->clear();
    ring.taken(ChunkQueue::max_bytes + 1 + mcap::message_head);
    CHECK(ring.has_room());
    fill(ChunkQueue::max_bytes / 2);
    CHECK(ring.has_room());
    fill(ChunkQueue::max_bytes / 2);
    CHECK(!ring.has_room());
  }
}

// From the recorder's thread to pages: bounded, evenly thinned, counted.
#include "tools/console/feed.h"

#include <doctest/doctest.h>

#include <atomic>
#include <thread>

#include "graph/values/type_of.h"
#include "tools/console/samples_json.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;
using tools::console::Batch;
using tools::console::Feed;
using tools::console::Samples;
using tools::console::SamplesJson;

std::vector<std::int64_t> instants_of(const Batch& batch, std::size_t output = 0) {
  std::vector<std::int64_t> all;
  for (const Duration instant : batch.samples[output].instants) all.push_back(instant.count());
  return all;
}

void take(Feed& feed, std::int64_t from, std::int64_t to) {
  for (std::int64_t i = from; i < to; ++i) {
    const double value = 10.0 * static_cast<double>(i);
    feed.take(Duration(i), 0, &value);
  }
  feed.pause();
}

struct Mixed {
  enum class Word : std::uint8_t { zero, one };
  bool is = true;
  float half = 0.1F;
  double whole = 0.1;
  std::uint64_t large = 18446744073709551615U;
  Word word = Word::one;
  std::array<std::int32_t, 2> two{-1, 2};
  static constexpr auto fields() {
    using M = Mixed;
    return describe(field<&M::is>(), field<&M::half>("m"), field<&M::whole>(), field<&M::large>(), field<&M::word>(),
                    field<&M::two>());
  }
};
constexpr auto enumerators(Mixed::Word) {
  return std::array<Enumerator<Mixed::Word>, 2>{{{"zero", Mixed::Word::zero}, {"one", Mixed::Word::one}}};
}
}  // namespace

TEST_SUITE("console/feed") {
  TEST_CASE("with a stride every so manieth is kept, from the begin to the end, and the newest") {
    Feed feed({&type_of<double>()}, 8, {4});
    take(feed, 0, 10);
    Batch batch = feed.take_batch();
    CHECK(instants_of(batch) == std::vector<std::int64_t>{0, 4, 8, 9});
    CHECK(batch.thinned == 6);
    take(feed, 10, 16);
    batch = feed.take_batch();
    CHECK(instants_of(batch) == std::vector<std::int64_t>{12, 15});
    CHECK(batch.thinned == 4);
    CHECK(feed.take_batch().empty());
  }

  TEST_CASE("what comes is there once, in order") {
    Feed feed({&type_of<double>()}, 8);
    CHECK(feed.take_batch().empty());
    take(feed, 1, 4);
    Batch batch = feed.take_batch();
    CHECK(instants_of(batch) == std::vector<std::int64_t>{1, 2, 3});
    CHECK(*static_cast<const double*>(batch.samples[0].values[2].data()) == 30.0);
    CHECK(batch.newest() == 3ns);
    CHECK(batch.thinned == 0);
    CHECK(feed.take_batch().empty());
  }

  TEST_CASE("beyond its room every second sample is left out and counted, the newest is there always") {
    Feed feed({&type_of<double>()}, 4);
    take(feed, 0, 5);
    Batch batch = feed.take_batch();
    CHECK(instants_of(batch) == std::vector<std::int64_t>{0, 2, 4});
    CHECK(batch.thinned == 2);
    take(feed, 0, 1000);
    batch = feed.take_batch();
    const std::vector<std::int64_t> kept = instants_of(batch);
    REQUIRE(kept == std::vector<std::int64_t>{0, 512, 999});
    CHECK(batch.thinned + kept.size() == 1000);
    CHECK(*static_cast<const double*>(batch.samples[0].values[2].data()) == 9990.0);
  }

  TEST_CASE("what nobody has come for is filled on, and what was taken stays as it is") {
    Feed feed({&type_of<double>()}, 8);
    take(feed, 0, 2);
    take(feed, 2, 3);
    const Batch& first = feed.take_batch();
    const double value = 7;
    feed.take(3ns, 0, &value);  // and is under way
    CHECK(instants_of(first) == std::vector<std::int64_t>{0, 1, 2});
    CHECK(feed.take_batch().empty());
    take(feed, 4, 5);
    CHECK(instants_of(feed.take_batch()) == std::vector<std::int64_t>{3, 4});
  }

  TEST_CASE("who asks more often than anything comes gets nothing twice, and all that comes then") {
    Feed feed({&type_of<double>()}, 8);
    for (std::int64_t i = 0; i < 6; ++i) {
      for (int again = 0; i % 2 == 1 && again < 2; ++again) CHECK(feed.take_batch().empty());
      take(feed, i, i + 1);
      CHECK(instants_of(feed.take_batch()) == std::vector<std::int64_t>{i});
    }
  }

  TEST_CASE("values of changing size are what they were, in memory that was used before, and thinned") {
    struct Window {
      Sequence<double> all{};
      static constexpr auto fields() { return describe(field<&Window::all>()); }
    };
    const Type& type = type_of<Window>();
    std::vector<std::byte> memory(1 << 16);
    std::pmr::monotonic_buffer_resource resource(memory.data(), memory.size());
    Feed feed({&type}, 4);
    for (std::size_t round = 0; round < 4; ++round) {
      for (std::size_t i = 0; i < 5; ++i) {
        Value value(type);
        auto& all = static_cast<Window*>(value.data())->all;
        for (std::size_t j = 0; j < 7 * (i + round) % 5; ++j) all.push_back(static_cast<double>(10 * i + j));
        feed.take(Duration(static_cast<std::int64_t>(i)), 0, value.data());
      }
      feed.pause();
      const Batch& batch = feed.take_batch();
      REQUIRE(instants_of(batch) == std::vector<std::int64_t>{0, 2, 4});
      for (std::size_t at = 0; at < 3; ++at) {
        const std::size_t i = 2 * at;
        const auto& all = static_cast<const Window*>(batch.samples[0].values[at].data())->all;
        REQUIRE(all.size() == 7 * (i + round) % 5);
        for (std::size_t j = 0; j < all.size(); ++j) CHECK(all[j] == static_cast<double>(10 * i + j));
      }
    }
  }

  TEST_CASE("between two threads nothing is lost, doubled or out of order") {
    constexpr std::int64_t all = 200'000;
    Feed feed({&type_of<double>()}, 16);
    std::atomic<bool> over = false;
    std::thread recorder([&] {
      for (std::int64_t i = 0; i < all; i += 10) {
        take(feed, i, i + 10);
        if (i % 1000 == 0) std::this_thread::sleep_for(100us);  // the other one asks again and again
      }
      over = true;
    });
    std::int64_t last = -1, kept = 0, disordered = 0;
    std::uint64_t thinned = 0;
    for (bool was_over = false; !was_over;) {
      was_over = over;
      const Batch& batch = feed.take_batch();
      thinned += batch.thinned;
      if (batch.samples.empty()) continue;
      const Samples& samples = batch.samples[0];
      for (std::size_t i = 0; i < samples.instants.size(); ++i, ++kept) {
        const std::int64_t instant = samples.instants[i].count();
        if (instant <= last ||
            *static_cast<const double*>(samples.values[i].data()) != 10.0 * static_cast<double>(instant))
          ++disordered;
        last = instant;
      }
    }
    recorder.join();
    CHECK(disordered == 0);
    CHECK(last == all - 1);
    CHECK(static_cast<std::uint64_t>(kept) + thinned == all);
  }

  TEST_CASE("outputs that nothing is known of, and those beyond the last, are left alone") {
    Feed feed({nullptr, &type_of<double>()}, 4);
    const double value = 1;
    feed.take(1ns, 0, &value);
    feed.take(1ns, 7, &value);
    feed.pause();
    CHECK(feed.wants(0));
    CHECK_FALSE(feed.wants(7));
    CHECK(feed.take_batch().empty());
  }

  TEST_CASE("events beyond a thousand are counted") {
    Feed feed({}, 4);
    for (std::size_t i = 0; i < Feed::max_events + 3; ++i)
      feed.take_event({RunEvent::Kind::fault, Duration(i), 2, 5, "was late"});
    feed.finish();
    const Batch batch = feed.take_batch();
    REQUIRE(batch.events.size() == Feed::max_events);
    CHECK(batch.events[0].cause == "was late");
    CHECK(batch.events[0].task == 2);
    CHECK(batch.lost_events == 3);
  }

  TEST_CASE("values are numbers to the bit, in the order of their leaves") {
    const Type& type = type_of<Mixed>();
    Feed feed({&type}, 4);
    const Mixed value;
    feed.take(1500ms, 0, &value);
    feed.pause();
    const SamplesJson json({&type});
    const auto parts = json.parts_of(feed.take_batch(), 1000);
    REQUIRE(parts.size() == 1);
    CHECK(parts[0] == "[0,1.5,1,0.1,0.1,18446744073709551615,1,-1,2]");
  }

  TEST_CASE("what is no number in JSON is null") {
    std::string text;
    const std::vector<Leaf> leaves = leaves_of(type_of<double>());
    const double infinite = std::numeric_limits<double>::infinity();
    SamplesJson::append(text, leaves, &infinite);
    CHECK(text == "null");
  }

  TEST_CASE("many samples come in parts, none of them lost") {
    Feed feed({&type_of<double>()}, 1000);
    take(feed, 0, 500);
    const SamplesJson json({&type_of<double>()});
    const auto parts = json.parts_of(feed.take_batch(), 100);
    CHECK(parts.size() > 10);
    std::size_t samples = 0;
    for (const std::string& part : parts)
      samples += static_cast<std::size_t>(std::count(part.begin(), part.end(), '['));
    CHECK(samples == 500);
  }
}

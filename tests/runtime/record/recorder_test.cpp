#include "runtime/record/recorder.h"

#include <doctest/doctest.h>

#include <stdexcept>
#include <thread>

#include "graph/text/errors.h"
#include "graph/values/type_of.h"

namespace {
using namespace jarol;

struct Collect : RecordSink {
  void take(Duration instant, std::uint32_t output, const void* value) override {
    double number = 0;
    std::memcpy(&number, value, sizeof number);
    in_order &= instant.count() == count && output == static_cast<std::uint32_t>(count % 7) &&
                number == static_cast<double>(count) / 3;
    ++count;
  }
  void take_event(const RunEvent&) override { ++events; }
  void finish() override { finished = true; }
  std::int64_t count = 0;
  int events = 0;
  bool in_order = true;
  bool finished = false;
};

struct Full : RecordSink {
  void take(Duration, std::uint32_t, const void*) override { throw std::runtime_error("the disk is full"); }
  void finish() override {}
};

void append(Recorder& recorder, std::int64_t count, std::int64_t from = 0) {
  for (std::int64_t i = from; i < count; ++i) {
    const double number = static_cast<double>(i) / 3;
    recorder.append(Duration(i), static_cast<std::uint32_t>(i % 7), &number, sizeof number);
  }
}
}  // namespace

TEST_SUITE("runtime/recorder") {
  TEST_CASE("every value arrives once and in order, also when the ring wraps many times") {
    Collect sink;
    Recorder recorder({&sink});
    append(recorder, 1'000'000);
    recorder.close();
    CHECK(sink.count == 1'000'000);
    CHECK(sink.in_order);
    CHECK(sink.finished);
  }

  TEST_CASE("one that never waits loses what comes while its sinks are a ring behind, and says from when on") {
    // stands still at its first value until it is let go
    struct Stuck : Collect {
      void take(Duration instant, std::uint32_t output, const void* value) override {
        free.wait(false);
        Collect::take(instant, output, value);
      }
      std::atomic<bool> free{false};
    };
    constexpr std::int64_t in_a_chunk = (256 << 10) / 24;
    Stuck sink;
    Recorder recorder({&sink});
    recorder.never_wait();
    append(recorder, 1'000'000);
    CHECK(recorder.lost() == "values could not be written as fast as they came; from 76454ns on they are lost");
    sink.free = true;
    sink.free.notify_all();
    CHECK_THROWS_WITH_AS(recorder.close(),
                         "values could not be written as fast as they came; from 76454ns on they are lost", InputError);
    CHECK(sink.count == 7 * in_a_chunk);
    CHECK(sink.in_order);
  }

  TEST_CASE("what is handed on arrives before there is a chunk of it") {
    std::atomic<int> paused{0};
    struct Counting : Collect {
      explicit Counting(std::atomic<int>& number) : pauses(number) {}
      void pause() override {
        ++pauses;
        pauses.notify_all();
      }
      std::atomic<int>& pauses;
    } sink(paused);
    Recorder recorder({&sink});
    recorder.hand_on();  // there is nothing
    append(recorder, 10);
    recorder.hand_on();
    paused.wait(0);
    CHECK(sink.count == 10);
    recorder.close();
    CHECK(sink.count == 10);
  }

  TEST_CASE("whoever waits for the sinks calls them itself, in order, beside the thread of the recorder") {
    struct Threads : Collect {
      void take(Duration instant, std::uint32_t output, const void* value) override {
        Collect::take(instant, output, value);
        last = std::this_thread::get_id();
      }
      std::thread::id last;
    } sink;
    Recorder recorder({&sink});
    int called_here = 0;
    for (std::int64_t end = 0; end < 400'000; recorder.catch_up()) {
      CHECK(sink.count == end);
      if (end > 0 && sink.last == std::this_thread::get_id()) ++called_here;
      const std::int64_t begin = end;
      end += begin % 3 == 0 ? 40 : 20'000;
      append(recorder, end, begin);
    }
    CHECK(called_here > 0);
    CHECK(sink.in_order);
    recorder.close();
    CHECK(sink.finished);
  }

  TEST_CASE("a recorder without values closes too") {
    Collect sink;
    Recorder recorder({&sink});
    recorder.close();
    CHECK(sink.count == 0);
    CHECK(sink.finished);
  }

  TEST_CASE("a sink that can't finish takes no other with it") {
    struct Broken : Collect {
      void finish() override { throw std::runtime_error("the disk is full"); }
    };
    Broken first;
    Collect second;
    Recorder recorder({&first, &second});
    append(recorder, 10);
    CHECK_THROWS_WITH_AS(recorder.close(), "the disk is full", std::runtime_error);
    CHECK(second.count == 10);
    CHECK(second.finished);
  }

  TEST_CASE("a sink that fails on the way takes no other with it, and it is known which has not got all") {
    struct FailsAt : Collect {
      void take(Duration instant, std::uint32_t output, const void* value) override {
        if (count == 3) throw std::runtime_error("the disk is full");
        Collect::take(instant, output, value);
      }
      void pause() override { throw std::runtime_error("it should be asked no more"); }
    };
    Collect first, last;
    FailsAt broken;
    Recorder recorder({&first, &broken, &last});
    append(recorder, 100'000);
    recorder.catch_up();
    CHECK(first.count == 100'000);
    CHECK_THROWS_WITH_AS(recorder.rethrow_failure(), "the disk is full", std::runtime_error);
    recorder.append_event({.kind = RunEvent::Kind::fault, .cause = "late"});
    CHECK_THROWS_WITH_AS(recorder.close(), "the disk is full", std::runtime_error);
    for (const Collect* sink : {&first, &last}) {
      CHECK(sink->count == 100'000);
      CHECK(sink->in_order);
      CHECK(sink->events == 1);
      CHECK(sink->finished);
      CHECK(recorder.why_not_all(*sink) == "");
    }
    CHECK(broken.count == 3);
    CHECK(broken.events == 0);
    CHECK(!broken.finished);  // what it has is not whole
    CHECK(recorder.why_not_all(broken) == "the disk is full");
  }

  TEST_CASE("one that can takes directly, on the thread that publishes, and the others get all besides") {
    struct Direct : DirectSink {
      void take_directly(Bell* bell) override { is_direct = bell != nullptr; }
      bool carry() override { return false; }
      bool wants(std::uint32_t output) const override { return output != 3; }
      void take(Duration, std::uint32_t output, const void*) override {
        CHECK(wants(output));
        on_this_thread &= std::this_thread::get_id() == publishing;
        if (++count == fails_at) throw std::runtime_error("the disk is full");
      }
      void take_event(const RunEvent&) override { ++events; }
      void finish() override { finished = true; }
      const std::thread::id publishing = std::this_thread::get_id();
      bool is_direct = false, on_this_thread = true, finished = false;
      std::int64_t count = 0, fails_at = -1, events = 0;
    };
    static const Type& type = type_of<double>();
    const std::vector<Output> outputs(7, Output{"o", &type});
    SUBCASE("in order") {
      Direct direct;
      Collect other;
      Recorder recorder({&other, &direct});
      recorder.expect(outputs);
      append(recorder, 7000);
      CHECK(direct.count == 6000);
      recorder.append_event({.kind = RunEvent::Kind::fault, .cause = "late"});
      CHECK(direct.events == 1);
      recorder.close();
      CHECK((direct.is_direct && direct.on_this_thread && direct.finished));
      CHECK((other.count == 7000 && other.in_order && other.events == 1 && other.finished));
    }
    SUBCASE("it fails") {
      Direct direct;
      direct.fails_at = 10;
      Collect other;
      Recorder recorder({&direct, &other});
      recorder.expect(outputs);
      append(recorder, 7000);
      recorder.catch_up();
      CHECK(recorder.failure_of(direct) == "the disk is full");
      CHECK(recorder.failure_of(other) == "");
      CHECK_THROWS_WITH_AS(recorder.close(), "the disk is full", std::runtime_error);
      CHECK(direct.count == 10);
      CHECK(!direct.finished);
      CHECK((other.count == 7000 && other.in_order && other.finished));
    }
    SUBCASE("what comes out of order goes by the recorder's thread") {
      Direct direct;
      Recorder recorder({&direct});
      recorder.expect(outputs);
      recorder.put_in_order(Duration(1));
      append(recorder, 7000);
      recorder.close();
      CHECK((!direct.is_direct && !direct.on_this_thread && direct.finished));
      CHECK(direct.count == 6000);
    }
  }

  TEST_CASE("of several sinks that fail each says why") {
    struct Broken : Collect {
      void finish() override { throw std::runtime_error("the name is taken"); }
    };
    Full full;
    Broken broken;
    Collect last;
    Recorder recorder({&full, &broken, &last});
    append(recorder, 10);
    CHECK_THROWS_WITH_AS(recorder.close(), "the disk is full; the name is taken", std::runtime_error);
    CHECK(last.finished);
    CHECK(recorder.failure_of(full) == "the disk is full");
    CHECK(recorder.failure_of(broken) == "the name is taken");
    CHECK(recorder.failure_of(last) == "");
  }

  TEST_CASE("what a sink throws comes out of close, and the run is not held up") {
    Full sink;
    Recorder recorder({&sink});
    append(recorder, 1'000'000);
    CHECK_THROWS_WITH_AS(recorder.close(), "the disk is full", std::runtime_error);
  }
}

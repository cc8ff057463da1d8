// Values that are larger than a chunk of a recorder's ring.
#include <doctest/doctest.h>

#include <array>
#include <stdexcept>

#include "graph/text/errors.h"
#include "graph/values/type_of.h"
#include "runtime/record/recorder.h"

namespace {
using namespace jarol;

constexpr std::size_t ring_chunk = std::size_t{256} << 10;

struct WideTable {
  std::array<double, 40'000> cells{};
  static constexpr auto fields() { return describe(field<&WideTable::cells>()); }
};

// The output of each value, its length, and its last number.
struct LengthsOf : RecordSink {
  struct Got {
    std::uint32_t output;
    std::size_t length;
    double last;
    bool operator==(const Got&) const = default;
  };
  void take(Duration, std::uint32_t output, const void* value) override {
    if (output == 0) got.push_back({0, 1, *static_cast<const double*>(value)});
    if (output == 1) got.push_back({1, 40'000, static_cast<const WideTable*>(value)->cells.back()});
    if (output == 2) {
      const auto& all = *static_cast<const Sequence<double>*>(value);
      got.push_back({2, all.size(), all.back()});
    }
  }
  void finish() override {}
  std::vector<Got> got;
};

const std::vector<Output> large_outputs{
    {"number", &type_of<double>()}, {"table", &type_of<WideTable>()}, {"list", &type_of<Sequence<double>>()}};

Sequence<double> list_of(std::size_t length, double last) {
  Sequence<double> list;
  list.resize(length);
  list.back() = last;
  return list;
}

// Appends so many times a number, a table, and a list of that many numbers, and returns what is to arrive.
std::vector<LengthsOf::Got> append_each(Recorder& recorder, int times, std::size_t length) {
  std::vector<LengthsOf::Got> all;
  auto table = std::make_unique<WideTable>();
  for (int i = 0; i < times; ++i) {
    const double number = i;
    table->cells.back() = number + 0.25;
    const Sequence<double> list = list_of(length, number + 0.5);
    recorder.append(Duration(i), 0, &number, sizeof number);
    recorder.append(Duration(i), 1, table.get(), sizeof(WideTable));
    recorder.append_deep(Duration(i), 2, &list);
    all.insert(all.end(), {{0, 1, number}, {1, 40'000, number + 0.25}, {2, length, number + 0.5}});
  }
  return all;
}
}  // namespace

TEST_SUITE("runtime/large_values") {
  TEST_CASE("values larger than a chunk arrive whole and in their order") {
    static_assert(sizeof(WideTable) > ring_chunk);
    LengthsOf sink;
    Recorder recorder({&sink});
    recorder.expect(large_outputs);
    std::vector<LengthsOf::Got> all = append_each(recorder, 40, 40'000);
    for (const auto& each : append_each(recorder, 3, 10)) all.push_back(each);
    for (const auto& each : append_each(recorder, 20, 200'000)) all.push_back(each);
    recorder.catch_up();
    CHECK(sink.got == all);
    recorder.close();
    CHECK(recorder.lost() == "");
  }

  TEST_CASE("the last that a chunk has room for and the first that it has not arrive alike") {
    LengthsOf sink;
    Recorder recorder({&sink});
    recorder.expect(large_outputs);
    const std::size_t last = (ring_chunk - sizeof(RecordHeader) - sizeof(std::uint64_t)) / sizeof(double);
    std::vector<LengthsOf::Got> all = append_each(recorder, 3, last);
    for (const auto& each : append_each(recorder, 3, last + 1)) all.push_back(each);
    recorder.close();
    CHECK(sink.got == all);
  }

  TEST_CASE("values that take more memory together than is kept for them arrive, too") {
    LengthsOf sink;
    Recorder recorder({&sink});
    recorder.expect(large_outputs);
    const std::vector<LengthsOf::Got> all = append_each(recorder, 12, 1'500'000);
    recorder.close();
    CHECK(sink.got == all);
  }

  TEST_CASE("large values that come out of order are put in order") {
    LengthsOf sink;
    Recorder recorder({&sink});
    recorder.expect(large_outputs);
    recorder.put_in_order(Duration(5));
    for (const int instant : {0, 2, 1, 4, 3}) {
      const Sequence<double> list = list_of(40'000, instant);
      recorder.append_deep(Duration(instant), 2, &list);
    }
    recorder.close();
    CHECK(sink.got ==
          std::vector<LengthsOf::Got>{{2, 40'000, 0}, {2, 40'000, 1}, {2, 40'000, 2}, {2, 40'000, 3}, {2, 40'000, 4}});
  }

  TEST_CASE("one that never waits says from which large value on all is lost") {
    struct Stuck : LengthsOf {
      void take(Duration instant, std::uint32_t output, const void* value) override {
        free.wait(false);
        LengthsOf::take(instant, output, value);
      }
      std::atomic<bool> free{false};
    } sink;
    Recorder recorder({&sink});
    recorder.expect(large_outputs);
    recorder.never_wait();
    std::vector<LengthsOf::Got> all;
    for (int i = 0; i < 12; ++i) {
      const Sequence<double> list = list_of(40'000, i);
      recorder.append_deep(Duration(i), 2, &list);
      if (i < 7) all.push_back({2, 40'000, static_cast<double>(i)});
    }
    const double number = 1;
    recorder.append(Duration(12), 0, &number, sizeof number);
    sink.free = true;
    sink.free.notify_all();
    CHECK_THROWS_WITH_AS(recorder.close(),
                         "values could not be written as fast as they came; from 7ns on they are lost", InputError);
    CHECK(sink.got == all);
  }

  TEST_CASE("a value that no recording has room for is lost, which is said, and the others are not") {
    LengthsOf sink;
    Recorder recorder({&sink});
    recorder.expect(large_outputs);
    const double number = 3;
    recorder.append(Duration(1), 0, &number, sizeof number);
    const volatile std::uint32_t bytes = Recorder::max_bytes + 1;  // the compiler is not to know how many
    recorder.append(Duration(2), 1, &number, bytes);
    recorder.append(Duration(3), 1, &number, bytes + 1);
    recorder.append(Duration(4), 0, &number, sizeof number);
    const std::string why = "output 'table' had 1072693249 bytes at 2ns; values of up to 1072693248 can be recorded";
    CHECK(recorder.lost() == why);
    CHECK_THROWS_WITH_AS(recorder.close(), why.c_str(), InputError);
    CHECK(recorder.why_not_all(sink) == why);
    CHECK(sink.got == std::vector<LengthsOf::Got>{{0, 1, 3}, {0, 1, 3}});
  }
}

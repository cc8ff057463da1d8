// Thousands of random graphs give what the oracle gives, value by value and deadline by deadline.
#include <doctest/doctest.h>

#include "runtime/execute/executor.h"
#include "tests/graph/graph_of.h"
#include "tests/how_many.h"
#include "tests/runtime/oracle.h"
#include "tests/runtime/random_model.h"

namespace {
using namespace jarol;

constexpr Duration end{std::int64_t{60'000'000}};

// Every publication of plain numbers.
class Collect : public RecordSink {
 public:
  explicit Collect(const Graph& graph) : outputs_(outputs_of(graph)) {}
  void take(Duration instant, std::uint32_t output, const void* value) override {
    trace.emplace_back(instant.count(), outputs_[output].name, *static_cast<const double*>(value));
  }
  void finish() override { std::sort(trace.begin(), trace.end()); }
  oracle::Trace trace;

 private:
  std::vector<Output> outputs_;
};

// The first difference between two traces, for people; nothing if there is none.
std::string first_difference(const oracle::Trace& is, const oracle::Trace& should) {
  const auto text = [](const oracle::Trace& trace, std::size_t i) {
    if (i >= trace.size()) return std::string("nothing");
    const auto& [instant, name, value] = trace[i];
    return std::to_string(instant) + " ns " + name + "=" + number_text(value);
  };
  for (std::size_t i = 0; i < std::max(is.size(), should.size()); ++i)
    if (i >= is.size() || i >= should.size() || is[i] != should[i])
      return "is " + text(is, i) + ", should be " + text(should, i);
  return "";
}

std::uint64_t count_of_graphs() { return tests::how_many(2'000, 20'000, 300); }
}  // namespace

TEST_SUITE("runtime/random_graphs") {
  TEST_CASE("random graphs run as the oracle interprets them") {
    for (std::uint64_t seed = 0; seed < count_of_graphs(); ++seed) {
      const oracle::Model model = oracle::random_model(seed);
      const std::string yaml = oracle::to_yaml(model, 0);
      CAPTURE(seed);
      CAPTURE(yaml);
      const oracle::Result should = oracle::interpret(model, end.count());
      const Graph graph = tests::graph_of(yaml);

      Collect collect(graph);
      Recorder recorder({&collect});
      Executor executor(graph, {}, {.digest = true, .recorder = &recorder});
      executor.run_until(end);
      recorder.close();
      REQUIRE(first_difference(collect.trace, should.trace) == "");
      REQUIRE(executor.report().digest == should.digest);
      REQUIRE(executor.report().activations == should.activations);
      REQUIRE(executor.report().instants == should.instants);

      // another order of declaration, no recorder, and in pieces of random lengths
      const Graph shuffled = tests::graph_of(oracle::to_yaml(model, seed + 1));
      Executor pieces(shuffled, {});
      for (Duration at{}; at < end;
           at +=
           Duration(1 + static_cast<std::int64_t>((seed * 7919 + static_cast<std::uint64_t>(at.count())) % 9'000'000)))
        pieces.run_until(at);
      pieces.run_until(end);
      REQUIRE(pieces.report().digest == should.digest);
      REQUIRE(pieces.report().activations == should.activations);

      for (const auto& found : oracle::enumerate_deadlines(model)) {
        const std::string& name = found.first;
        CAPTURE(name);
        const auto task =
            std::find_if(graph.tasks.begin(), graph.tasks.end(), [&](const Task& t) { return t.name == name; });
        REQUIRE(task->deadline.count() == found.second);
      }
    }
  }
}

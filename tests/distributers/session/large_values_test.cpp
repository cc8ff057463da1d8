// Sessions of values that are larger than a chunk of the recorder's ring.
#include <doctest/doctest.h>

#include "distributers/session/graph_run.h"
#include "distributers/session/session.h"
#include "tests/distributers/all_parts.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;

struct Cloud {
  double nearest = 0;
  Sequence<double> points{};
  static constexpr auto fields() { return describe(field<&Cloud::nearest>("m"), field<&Cloud::points>("m")); }
};

// Large and near from activation 4 to 7.
struct Scan {
  static constexpr std::string_view summary = "for tests";
  struct Out {
    Cloud cloud{};
    static constexpr auto fields() { return describe(field<&Out::cloud>()); }
  };
  static void run(const Tick& tick, Out& out) {
    const bool is_near = tick.activation >= 4 && tick.activation < 8;
    out.cloud.nearest = is_near ? 1 : 10;
    out.cloud.points.resize(is_near ? 50'000 : 10);
    out.cloud.points.back() = static_cast<double>(tick.activation);
  }
};

struct Wide {
  static constexpr std::string_view summary = "for tests";
  struct Out {
    std::array<double, 40'000> cells{};
    static constexpr auto fields() { return describe(field<&Out::cells>()); }
  };
  static void run(const Tick& tick, Out& out) { out.cells.back() = static_cast<double>(tick.activation); }
};

std::shared_ptr<const Source> scanning() {
  return std::make_shared<const Source>(Source{"t.yaml", R"(
graph: t
timing: {period: 100ms}
tasks: {scan: {type: Scan, heap: 64MiB, wcet: 1ms}}
expect: [always scan.cloud.nearest > 5, min(scan.cloud.nearest) > 5]
)"});
}

const distributers::Registries& parts() { return tests::all_parts_with<Scan, Wide>(); }

std::string lines_of(const RunVerdict& verdict) {
  std::string text;
  for (const Verdict& v : verdict.expectations)
    text +=
        v.condition + ": " + (v.outcome == Verdict::Outcome::fails ? "fails" : "does not fail") + ", " + v.why + "\n";
  return text;
}

const std::string both_fail =
    "always scan.cloud.nearest > 5: fails, was not so at 0.4 s: 1 m\n"
    "min(scan.cloud.nearest) > 5: fails, reached 1 m\n";
}  // namespace

TEST_SUITE("distributers/session/large_values") {
  TEST_CASE("a large value is watched, shown and judged like any other") {
    Session session(parts(), scanning());
    session.watch("*");
    session.run_until(600ms);
    CHECK(session.value<double>("scan.cloud.nearest") == 1);
    CHECK(session.value<Cloud>("scan.cloud").points.size() == 50'000);
    CHECK(session.value<Cloud>("scan.cloud").points.back() == 5);
    session.run_until(1s);
    const auto samples = session.samples<double>("scan.cloud.nearest");
    REQUIRE(samples.size() == 10);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      CHECK(samples[i].instant == i * 100ms);
      CHECK(samples[i].value == (i >= 4 && i < 8 ? 1 : 10));
    }
    const RunVerdict verdict = session.finish();
    CHECK(verdict.is_negative());
    CHECK(verdict.unseen == "");
    CHECK(lines_of(verdict) == both_fail);
  }

  TEST_CASE("a checkpoint after large values keeps what they broke") {
    Session first(parts(), scanning()), second(parts(), scanning());
    first.run_until(900ms);
    second.restore(first.checkpoint());
    second.run_until(1s);
    CHECK(lines_of(second.finish()) == both_fail);
  }

  TEST_CASE("a flat value of that size is no obstacle to a session") {
    Session session(parts(), std::make_shared<const Source>(
                                 Source{"t.yaml", "{graph: t, tasks: {a: {type: Wide, period: 10ms, wcet: 1us}}}"}));
    session.run_until(50ms);
    CHECK(session.value<std::array<double, 40'000>>("a.cells").back() == 4);
    CHECK_FALSE(session.finish().is_negative());
  }

  TEST_CASE("a run of which something was lost is not saved as if it was whole") {
    Loaded loaded = load_graph(scanning(), parts(), {}, 0);
    RunOrigin origin = origin_of(loaded, {}, 0);
    GraphRun run(std::move(loaded), {});
    run.set_origin(std::move(origin));
    run.connect(no_notes);
    run.executor().run_until(300ms);
    CHECK(run.checkpoint().instant() == 300ms);
    const std::byte unread{};
    const volatile std::uint32_t bytes = Recorder::max_bytes + 1;  // the compiler is not to know how many
    run.sinks().recorder()->append(300ms, 0, &unread, bytes);
    CHECK_THROWS_WITH_AS(
        run.checkpoint(),
        "the run can't be saved, as not all that it published could be looked at: output 'scan.cloud' had 1072693249 "
        "bytes at 300000000ns; values of up to 1072693248 can be recorded",
        CheckpointError);
    run.disconnect();
    RunVerdict verdict;
    CHECK_FALSE(verdict.is_negative());
    verdict.unseen = run.sinks().lost();
    CHECK(verdict.is_negative());
  }
}

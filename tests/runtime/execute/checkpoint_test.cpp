// A run that is saved between any two instants and goes on in another executor ends as the one in one piece.
#include <doctest/doctest.h>

#include <cstring>

#include "graph/values/archive.h"
#include "graph/values/seed.h"
#include "runtime/execute/executor.h"
#include "tests/graph/graph_of.h"
#include "tests/how_many.h"
#include "tests/runtime/random_model.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;

// Its texts grow and shrink, some are lost; what it knows depends on which blocks of its heap are free.
struct Diary {
  static constexpr std::string_view summary = "for tests";
  struct In {
    Sequence<String> heard{};
    double number = 0;
    static constexpr auto fields() { return describe(field<&In::heard>(), field<&In::number>()); }
  };
  struct State {
    Sequence<String> pages{};
    Sequence<Sequence<double>> tables{};
    String title{"begun"};
    static constexpr auto fields() {
      return describe(field<&State::pages>(), field<&State::tables>(), field<&State::title>());
    }
  };
  struct Out {
    Sequence<String> reported{};
    double size = 0;
    static constexpr auto fields() { return describe(field<&Out::reported>(), field<&Out::size>()); }
  };
  static void run(const Tick& tick, const In& in, State& state, Out& out) {
    const std::uint64_t chance = spread_seed(static_cast<std::uint64_t>(tick.activation), "diary");
    state.title += "x";
    if (chance % 5 == 0) state.title = "anew";
    String page = "p";
    for (std::uint64_t i = 0; i < chance % 9; ++i) page += page;
    if (state.pages.size() > 4) state.pages.resize(chance % 4);
    state.pages.push_back(page);
    state.tables.resize(chance % 6);
    for (auto& table : state.tables) table.push_back(in.number + static_cast<double>(table.size()));
    if (chance % 13 == 0) throw std::runtime_error("torn " + std::to_string(tick.activation));
    out.reported = state.pages;
    out.size = static_cast<double>(state.pages.size() + state.tables.size() + in.heard.size() + state.title.size());
    if (chance % 17 == 0) out.size /= 0.0;
  }
};

// Writes where it may, but no value of the type.
struct Careless {
  static constexpr std::string_view summary = "for tests";
  struct State {
    bool flag = false;
    static constexpr auto fields() { return describe(field<&State::flag>()); }
  };
  static void run(const Tick&, State& state) { std::memset(&state.flag, 7, 1); }
};

const Registry& registry() {
  static const Registry made = [] {
    Registry all;
    tasks::add_tasks(all);
    all.add(task_class<Diary>());
    all.add(task_class<Careless>());
    return all;
  }();
  return made;
}

// Deep values in a circle, heaps that overflow, policies, LETs under way.
std::string diaries(std::uint64_t seed) {
  std::string tasks, connections;
  for (int i = 0; i < 6; ++i) {
    const std::uint64_t chance = spread_seed(seed, std::to_string(i));
    const std::uint64_t period = 1 + chance % 7, let = 1 + chance / 8 % period;
    const std::string name = "d" + std::to_string(i), next = "d" + std::to_string((i + 1) % 6);
    tasks += "  " + name + ": {type: Diary, period: " + std::to_string(period) +
             "ms, on_fault: " + (chance % 2 == 0 ? "hold" : "skip") +
             ", heap: " + std::to_string(2000 + chance % 6000) + "B" +
             (i == 0 || chance % 3 == 0 ? ", let: " + std::to_string(let) + "ms" : "") + "}\n";
    connections += "  - " + name + ".reported -> " + next + ".heard\n  - " + name + ".size -> " + next + ".number\n";
  }
  return "graph: diaries\ntasks:\n" + tasks + "connections:\n" + connections;
}

Archive::Bytes saved(Executor& executor) {
  Archive::Bytes bytes;
  Archive archive = Archive::to(bytes);
  executor.serialize(archive);
  return bytes;
}

void restore(Executor& executor, const Archive::Bytes& bytes) {
  Archive archive = Archive::from(bytes);
  executor.serialize(archive);
  archive.require_end();
}

ExecutorOptions by(std::size_t workers) {
  return {.workers = workers, .sharing = workers > 1 ? Sharing::always : Sharing::if_it_pays};
}

// Saved at `at` of a run with some workers, it ends the same with other ones; `ran` before, for a while.
void check_goes_on(const Graph& graph, Duration end, Duration at, std::uint64_t seed) {
  Executor whole(graph, {});
  whole.run_until(end);
  Executor first(graph, {}, by(std::size_t{1} << seed % 3));
  first.run_until(at);
  const Archive::Bytes bytes = saved(first);
  Executor second(graph, {}, by(std::size_t{1} << (seed + 1) % 3));
  if (seed % 2 == 0) second.run_until(end / 2);
  restore(second, bytes);
  REQUIRE(saved(second) == bytes);
  REQUIRE(second.now() == at);
  second.run_until(end);
  REQUIRE(second.report().digest == whole.report().digest);
  REQUIRE(saved(second) == saved(whole));
  first.run_until(end);  // that it was saved changes nothing
  REQUIRE(saved(first) == saved(whole));
}

Duration any_instant(Duration end, std::uint64_t seed) {
  return Duration(static_cast<std::int64_t>(spread_seed(seed, "at") % static_cast<std::uint64_t>(end.count() + 1)));
}

}  // namespace

TEST_SUITE("runtime/checkpoint") {
  TEST_CASE("random graphs that are saved and restored end as in one piece") {
    const std::uint64_t graphs = tests::how_many(200, 2'000);
    for (std::uint64_t seed = 0; seed < graphs; ++seed) {
      CAPTURE(seed);
      const Graph graph = tests::graph_of(oracle::to_yaml(oracle::random_model(seed), 0));
      check_goes_on(graph, 60ms, any_instant(60ms, seed), seed);
    }
  }

  TEST_CASE("deep values, heaps that overflow, faults and LETs under way are restored to the bit") {
    std::uint64_t faults = 0;
    for (std::uint64_t seed = 0; seed < tests::how_many(40U, 500U); ++seed) {
      CAPTURE(seed);
      const Graph graph = tests::graph_of(registry(), diaries(seed));
      check_goes_on(graph, 300ms, any_instant(300ms, seed), seed);
      Executor whole(graph, {});
      whole.run_until(300ms);
      faults += whole.report().fault_count;
    }
    CHECK(faults > 1000);
  }

  TEST_CASE("bytes that are damaged anywhere are refused or give a run that goes on, never a crash") {
    const Graph graph = tests::graph_of(registry(), diaries(3));
    Executor first(graph, {});
    first.run_until(40ms);
    const Archive::Bytes good = saved(first);
    std::uint64_t refused = 0;
    for (std::uint64_t seed = 0; seed < tests::how_many(1'000U, 20'000U); ++seed) {
      CAPTURE(seed);
      Archive::Bytes bytes = good;
      for (std::uint64_t i = 0; i <= seed % 3; ++i) {
        const std::uint64_t chance = spread_seed(seed, "damage" + std::to_string(i));
        if (chance % 10 == 0)
          bytes.resize(chance / 16 % (bytes.size() + 1));
        else if (!bytes.empty())
          bytes[chance / 16 % bytes.size()] = std::byte(chance % 3 == 0 ? 0xff : chance / 7);
      }
      Executor second(graph, {});
      try {
        restore(second, bytes);
        second.run_until(std::min<Duration>(second.now(), 1h) + 20ms);
      } catch (const ArchiveError&) { ++refused; }
    }
    CHECK(refused > 300);
  }

  TEST_CASE("what a restored run can't be is said") {
    const Graph graph = tests::graph_of("graph: t\ntasks: {a: {type: Counter, period: 1ms}}\n");
    const Graph other = tests::graph_of(
        "graph: t\ntasks: {a: {type: Sum, period: 1ms}, b: {type: Counter, period: 1ms}}\n"
        "connections: [b.out -> a.a, b.out -> a.b]\n");
    Executor first(graph, {});
    first.run_until(5ms);
    Executor second(other, {});
    CHECK_THROWS_WITH_AS(restore(second, saved(first)), "is of other tasks", ArchiveError);
    Archive::Bytes bytes = saved(first);
    bytes.pop_back();
    Executor third(graph, {});
    CHECK_THROWS_WITH_AS(restore(third, bytes), "ends within its state", ArchiveError);
    bytes = saved(first);
    bytes.emplace_back();
    CHECK_THROWS_WITH_AS(restore(third, bytes), "goes on after its state", ArchiveError);
  }

  TEST_CASE("a state that could not be restored is not saved, and its task is named") {
    const Graph graph = tests::graph_of(registry(), "graph: t\ntasks: {a: {type: Careless, period: 1ms}}\n");
    Executor executor(graph, {});
    saved(executor);
    executor.run_until(1ms);
    CHECK_THROWS_WITH_AS(saved(executor), "task 'a': a State has 7 where true or false stand", NotSaveable);
  }

  TEST_CASE("a run that a fault has stopped is restored as one") {
    const std::string text = diaries(1);
    std::string stops = text;
    for (std::size_t at = stops.find("hold"); at != std::string::npos; at = stops.find("hold"))
      stops.replace(at, 4, "stop");
    for (std::size_t at = stops.find("skip"); at != std::string::npos; at = stops.find("skip"))
      stops.replace(at, 4, "stop");
    const Graph graph = tests::graph_of(registry(), stops);
    Executor first(graph, {});
    first.run_until(10s);
    REQUIRE(first.report().stopped);
    Executor second(graph, {});
    restore(second, saved(first));
    second.run_until(20s);
    CHECK(second.report().stopped);
    CHECK(second.now() == first.now());
    CHECK(to_text(second.report().faults.back()) == to_text(first.report().faults.back()));
  }
}

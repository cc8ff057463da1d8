// The vehicle of a run is brought to rest at its end, in real time, whoever runs the tasks.
// In one file: all cases bring one vehicle to rest.
#include "runtime/execute/rest.h"

#include <doctest/doctest.h>

#include <atomic>
#include <thread>

#include "graph/analysis/policies.h"
#include "graph/expect/at_end.h"
#include "runtime/jarol/jarol_core.h"
#include "tests/runtime/run_on_threads.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;

struct Command {
  double height = 0, lean = 0;
  static constexpr auto fields() { return describe(field<&Command::height>("m"), field<&Command::lean>("rad")); }
};

// Goes up or down by one at an activation.
struct Climb {
  static constexpr std::string_view summary = "for tests";
  struct In {
    Command command{};
    static constexpr auto fields() { return describe(field<&In::command>()); }
  };
  struct State {
    double height = 0;
    static constexpr auto fields() { return describe(field<&State::height>("m")); }
  };
  struct Out {
    double height = 0;
    static constexpr auto fields() { return describe(field<&Out::height>("m")); }
  };
  static void run(const Tick&, const In& in, State& state, Out& out) {
    state.height += std::clamp(in.command.height - state.height, -1.0, 1.0);
    out.height = state.height;
  }
};

// Wants to be at a height of 5, and leans more each time.
class Pilot : public ExternalSystem {
 public:
  explicit Pilot(std::optional<Duration> end) : end_(end) {}
  void reach(Duration) override {}
  bool take(std::size_t, void* value) override {
    *static_cast<Command*>(value) = {.height = 5, .lean = static_cast<double>(++taken)};
    return true;
  }
  void hand_over(std::size_t, const void*) override {}
  std::optional<Duration> end() const override { return end_; }
  void ending() override { ++endings; }
  bool overrides_end() const override { return demands_stop && endings > 0; }

  std::atomic<int> taken{0}, endings{0};
  bool demands_stop = false;

 private:
  std::optional<Duration> end_;
};

// Reports from one instant on until another.
class Plant : public ExternalSystem {
 public:
  explicit Plant(Duration from = {}, Duration until = Duration::max()) : from_(from), until_(until) {}
  void reach(Duration instant) override { now_ = instant; }
  bool take(std::size_t, void* value) override {
    *static_cast<double*>(value) = 0;
    return from_ <= now_ && now_ < until_;
  }
  void hand_over(std::size_t, const void* value) override { handed.push_back(*static_cast<const double*>(value)); }

  std::vector<double> handed;

 private:
  Duration from_, until_, now_{};
};

const Registry& registry() {
  static const Registry made = [] {
    Registry known;
    analysis::add_policies(known);
    tasks::add_tasks(known);
    known.add(task_class<Climb>());
    const Type* number = &type_of<double>();
    known.add(DistributerClass{
        "Plant", "for tests", {{"sensor", Direction::in, number, ""}, {"motor", Direction::out, number, ""}}, true});
    known.add(DistributerClass{"Pilot", "for tests", {{"command", Direction::in, &type_of<Command>(), ""}}, false});
    return known;
  }();
  return made;
}

constexpr const char* lands = "{command: {wish: {height: 0}}, until: climb.height < 0.5, longest: 10s}";

Graph graph_of_flight(const std::string& at_end, const std::string& let = "",
                      const std::string& platform = "{cores: 1}", const std::string& timeout = ", timeout: 1h",
                      const std::string& period = "10ms") {
  const std::string text = "graph: t\ntiming: {period: " + period + R"(}
platform: )" + platform + R"(
distributers: {pilot: {type: Pilot, link: {type: test}}, plant: {type: Plant, link: {type: test}}}
communicators:
  wish: {channel: pilot.command}
  sensor: {channel: plant.sensor)" +
                           timeout +
                           R"(}
  motor: {channel: plant.motor)" +
                           (timeout.empty() ? "" : ", safe: -1") +
                           R"(}
tasks: {climb: {type: Climb, on_fault: hold, priority: 1)" +
                           let + R"(}, r: {type: Relay, priority: 2, on_fault: hold}}
connections: [wish -> climb.command, climb.height -> motor, sensor -> r.in]
at_end: )" + at_end + "\n";
  Problems problems;
  const GraphSpec spec = load_spec(std::make_shared<Source>(Source{"t.yaml", text}), {}, problems);
  Graph graph = build_graph(spec, registry(), problems);
  expect::add_at_end(spec, graph, problems);
  problems.throw_if_any();
  return graph;
}

struct World {
  explicit World(std::optional<Duration> mission = {}, Plant reports = Plant()) {
    auto pilot_ = std::make_unique<Pilot>(mission);
    auto plant_ = std::make_unique<Plant>(reports);
    pilot = pilot_.get();
    plant = plant_.get();
    systems.push_back(std::move(pilot_));
    systems.push_back(std::move(plant_));
  }
  std::vector<std::unique_ptr<ExternalSystem>> systems;
  Pilot* pilot;
  Plant* plant;
};

double height_of(const Executor& executor) { return static_cast<const Command*>(executor.last_value(2))->height; }
}  // namespace

TEST_SUITE("runtime/execute/rest") {
  TEST_CASE("what is commanded is taken until the vehicle is at rest, in each way of running") {
    for (const char* let : {"", ", let: 10ms"})
      for (const char* platform : {"{cores: 1}", "{cores: 2}", "{cores: 1, policy: fixed_priority}"}) {
        CAPTURE(let);
        CAPTURE(platform);
        const Graph graph = graph_of_flight(lands, let, platform);
        World world;
        Plant& plant = *world.plant;
        RealClock clock(graph.tasks.size());
        const auto threads =
            std::string(platform) == "{cores: 1}" ? std::vector<analysis::TaskThread>() : analysis::threads_of(graph);
        Executor executor(graph, std::move(world.systems), {.clock = &clock, .threads = threads});
        clock.start();
        executor.cover(150ms);
        CHECK(height_of(executor) == 5);
        CHECK(!executor.rest().has_value());
        CHECK(executor.begin_rest() == 150ms);
        executor.cover_rest();
        executor.close();
        executor.finish();
        REQUIRE(executor.rest().has_value());
        const RestReport rest = *executor.rest();
        CHECK(rest.reached);
        CHECK(rest.begun == 150ms);
        // five steps down, and no more than it takes for the last of them to be published
        CHECK(rest.ended >= 190ms);
        if (executor.report().fault_count == 0) CHECK(rest.ended <= 210ms);
        CHECK(height_of(executor) == 0);
        REQUIRE(plant.handed.size() > 6);
        CHECK(plant.handed.back() == -1);  // safe, once
        CHECK(plant.handed[plant.handed.size() - 2] >= 0);
      }
  }

  TEST_CASE("fields that are not commanded go by the operator; a mission is over") {
    for (const bool mission : {false, true}) {
      CAPTURE(mission);
      const Graph graph = graph_of_flight("{command: {wish: {height: 0}}, until: climb.height < -1, longest: 100ms}");
      World world(mission ? std::optional<Duration>(1s) : std::nullopt);
      Pilot& pilot = *world.pilot;
      RealClock clock(graph.tasks.size());
      Executor executor(graph, std::move(world.systems), {.clock = &clock});
      clock.start();
      executor.cover(100ms);
      CHECK(pilot.taken == 10);
      executor.begin_rest();
      executor.cover_rest();
      CHECK(pilot.taken == (mission ? 10 : 20));
      CHECK(static_cast<const Command*>(executor.last_value(2))->lean == pilot.taken);
      CHECK(height_of(executor) == 0);
      // as long as it may take, for it is never so
      CHECK(!executor.rest()->reached);
      CHECK(executor.rest()->ended == 200ms);
    }
  }

  TEST_CASE("an operator learns of it once; one that demands a stop commands in its place, in either way of running") {
    for (const bool stops : {false, true}) {
      CAPTURE(stops);
      const Graph graph = graph_of_flight("{command: {wish: {height: 0}}, until: climb.height < -1, longest: 100ms}");
      World world;
      Pilot& pilot = *world.pilot;
      pilot.demands_stop = stops;
      RealClock clock(graph.tasks.size());
      Executor executor(graph, std::move(world.systems), {.clock = &clock});
      clock.start();
      executor.cover(100ms);
      CHECK(pilot.endings == 0);
      executor.begin_rest();
      executor.cover_rest();
      CHECK(pilot.endings == 1);
      CHECK(height_of(executor) == (stops ? 5 : 0));
      World other;
      Pilot& on_threads = *other.pilot;
      on_threads.demands_stop = stops;
      JarolCore core(graph, std::move(other.systems));
      core.run_for(100ms);
      CHECK(on_threads.endings == 1);
      CHECK(static_cast<const Command*>(core.last_value(2))->height == (stops ? 5 : 0));
    }
  }

  TEST_CASE("who asks for it has it from the next instant on; what a fault or an interrupt ended has none") {
    const Graph graph = graph_of_flight(lands);
    RealClock clock(graph.tasks.size());
    World world;
    Executor executor(graph, std::move(world.systems), {.clock = &clock});
    clock.start();
    std::thread asks([&] {
      while (executor.now() < 60ms) std::this_thread::yield();
      executor.ask_for_rest();
    });
    executor.cover(1h);
    asks.join();
    const auto begun = executor.begin_rest();
    REQUIRE(begun.has_value());
    CHECK(*begun > 60ms);
    CHECK(*begun == executor.now() + 10ms);
    executor.interrupt();
    executor.cover_rest();
    CHECK(!executor.rest()->reached);
    World other;
    RealClock again(graph.tasks.size());
    Executor interrupted(graph, std::move(other.systems), {.clock = &again});
    interrupted.interrupt();
    CHECK(!interrupted.begin_rest().has_value());
    World third;
    Executor on_virtual_clock(graph, std::move(third.systems));
    on_virtual_clock.run_until(100ms);
    CHECK(!on_virtual_clock.begin_rest().has_value());
  }

  TEST_CASE("what is published on the way there counts as published: a LET's value at its end") {
    // at 150 ms a height of 5 is published, and 4 is computed: it is not below 4.5 yet
    const Graph graph =
        graph_of_flight("{command: {wish: {height: 0}}, until: climb.height < 4.5, longest: 1s}", ", let: 10ms");
    CHECK(tests::at_some_speed([&](int) {
      World world;
      RealClock clock(graph.tasks.size());
      Executor executor(graph, std::move(world.systems), {.clock = &clock});
      clock.start();
      executor.cover(150ms);
      executor.begin_rest();
      executor.cover_rest();
      if (executor.report().fault_count > 0) return false;
      CHECK(executor.rest()->reached);
      CHECK(executor.rest()->ended == 160ms);
      return true;
    }));
  }

  TEST_CASE("threads bring it to rest as well, at their end or as they are asked") {
    for (const bool asked : {false, true})
      for (const bool mission : {false, true}) {
        CAPTURE(asked);
        CAPTURE(mission);
        const Graph graph = graph_of_flight(lands);
        World world(mission ? std::optional<Duration>(1s) : std::nullopt);
        Plant& plant = *world.plant;
        JarolCore core(graph, std::move(world.systems));
        std::thread asks([&] {
          while (asked && core.now() < 150ms) std::this_thread::sleep_for(1ms);
          if (asked) core.ask_for_rest();
        });
        core.run_for(asked ? Duration(1h) : Duration(150ms));
        asks.join();
        core.close();
        REQUIRE(core.rest().has_value());
        CHECK(core.rest()->reached);
        CHECK(core.rest()->begun >= 150ms);
        CHECK(core.rest()->ended >= core.rest()->begun + 40ms);
        CHECK(static_cast<const Command*>(core.last_value(2))->height == 0);
        CHECK(plant.handed.back() == -1);
      }
  }

  TEST_CASE("a vehicle that is not heard, or that nothing was published of since, is not known to be at rest") {
    struct Case {
      const char* timeout;
      Duration from, until;
      bool heard;
    };
    // begun at 50 ms, when the height of 0 at which it began was so long since; 60 ms at most
    for (const Case& each :
         {Case{", timeout: 1h", 1h, 2h, false}, Case{"", 1h, 2h, false}, Case{", timeout: 30ms", 0ms, 20ms, false},
          Case{"", 0ms, 20ms, true}, Case{", timeout: 30ms", 0ms, 2h, true}}) {
      CAPTURE(each.timeout);
      CAPTURE(each.until.count());
      const Graph graph = graph_of_flight("{command: {wish: {height: 0}}, until: climb.height < 9, longest: 60ms}", "",
                                          "{cores: 1}", each.timeout);
      World world({}, Plant(each.from, each.until));
      RealClock clock(graph.tasks.size());
      Executor executor(graph, std::move(world.systems), {.clock = &clock});
      clock.start();
      executor.cover(50ms);
      executor.begin_rest();
      executor.cover_rest();
      const RestReport rest = *executor.rest();
      CHECK(rest.reached == each.heard);
      CHECK(rest.heard == each.heard);
      if (!each.heard) CHECK(rest.ended == 110ms);
      World other({}, Plant(each.from, each.until));
      JarolCore core(graph, std::move(other.systems));
      core.run_for(50ms);
      CHECK(core.rest()->reached == each.heard);
      CHECK(core.rest()->heard == each.heard);
    }
    // published before, and not again before the end of its LET
    const Graph slow = graph_of_flight("{command: {wish: {height: 0}}, until: climb.height < 9, longest: 30ms}",
                                       ", let: 90ms", "{cores: 1}", ", timeout: 1h", "100ms");
    World world;
    RealClock clock(slow.tasks.size());
    Executor executor(slow, std::move(world.systems), {.clock = &clock});
    clock.start();
    executor.cover(100ms);
    executor.begin_rest();
    executor.cover_rest();
    CHECK(!executor.rest()->reached);
    CHECK(executor.rest()->heard);
  }

  TEST_CASE("threads give it up after the longest time") {
    const Graph graph = graph_of_flight("{command: {wish: {height: 0}}, until: climb.height < -1, longest: 55ms}");
    World world;
    JarolCore core(graph, std::move(world.systems));
    core.run_for(50ms);
    REQUIRE(core.rest().has_value());
    CHECK(!core.rest()->reached);
    CHECK(core.rest()->ended == core.rest()->begun + 60ms);  // whole rounds
  }
}

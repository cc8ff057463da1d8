#include "tools/bench/vehicles.h"

#include <filesystem>
#include <stdexcept>

#include "tools/bench/timing.h"
#include "tools/commands/run/load_graph.h"
#include "tools/library/session.h"
#ifdef JAROL_VEHICLES
#include "tools/bench/plain_helicopter.h"
#include "tools/bench/plain_submarine.h"
#endif

namespace jarol::bench {

#ifdef JAROL_VEHICLES

namespace {

constexpr const char* dive = "specs/exolauv.yaml";
constexpr const char* flight = "specs/javiator.yaml";

// One period of a graph after it has run up to a beginning: the microseconds that it takes in the loop, and that the
// plain vehicle takes. Slices are short, so that neighbours on the machine miss some.
struct Loop {
  const char* file;
  Duration beginning, period;
  int periods;  // of a slice
  double goal;  // times real time
};

Figure measure_loop(const std::string& name, const std::string& text, const Loop& loop, int repeats,
                    const std::function<double()>& plain_period) {
  auto loaded = tools::load_graph(loop.file, {});
  Executor executor(*loaded.graph, std::move(loaded.systems), {.digest = true});
  Duration until = loop.beginning;
  executor.run_until(until);
  const auto closed_loop = [&] {
    until += loop.periods * loop.period;
    return 1e6 * seconds_of([&] { executor.run_until(until); }) / loop.periods;
  };
  const auto alone = [&] {
    const double seconds = seconds_of([&] {
      for (int i = 0; i < loop.periods; ++i) keep(plain_period());
    });
    return 1e6 * seconds / loop.periods;
  };
  Figure figure = compare(name, text, 0, repeats, closed_loop, alone);
  figure.unit = "us";
  figure.goal = 1e-3 * static_cast<double>(loop.period.count()) / loop.goal / figure.floor;
  return figure;
}

Figure measure_rigid(const std::string& name, const std::string& text, const Loop& loop, const std::string& distributer,
                     int repeats) {
  const auto of = [&](const std::string& dynamics) {
    SessionOptions options;
    options.set = {"distributers." + distributer + ".link.parameters.dynamics=" + dynamics};
    auto run = std::make_shared<Session>(open(loop.file, options));
    run->run_for(loop.beginning);
    return [run, loop] { return 1e6 * seconds_of([&] { run->run_for(loop.periods * loop.period); }) / loop.periods; };
  };
  Figure figure = compare(name, text, 1.0 / 15, repeats, of("rigid"), of("simbody"));
  figure.unit = "us";
  return figure;
}

}  // namespace

bool has_vehicles() { return true; }

bool has_graphs() { return std::filesystem::exists(dive) && std::filesystem::exists(flight); }

Figure measure_dive(int repeats) {
  PlainSubmarine plain(vehicles::SubmarineParameters{});
  const Loop loop{dive, std::chrono::seconds(10), std::chrono::milliseconds(10), 50, 100};
  return measure_loop("dive",
                      "10 ms of the dive, all tasks and sensors (100 us: 100 times real time) / plain Eigen model",
                      loop, repeats, [&] {
                        plain.step(0.01, 180.0);
                        return plain.surge();
                      });
}

Figure measure_dive_rigid(int repeats) {
  return measure_rigid("dive_rigid", "10 ms of the dive with dynamics: rigid / with Simbody",
                       {dive, std::chrono::seconds(10), std::chrono::milliseconds(10), 50, 0}, "dune", repeats);
}

Figure measure_hover_rigid(int repeats) {
  return measure_rigid("hover_rigid", "15 ms in the air with dynamics: rigid / with Simbody",
                       {flight, std::chrono::milliseconds(7995), std::chrono::milliseconds(15), 10, 0}, "robostix",
                       std::min(repeats, 120));
}

Figure measure_hover(int repeats) {
  PlainHelicopter plain(vehicles::HelicopterParameters{}, 1.0);
  // in the air from 8 s to 28 s
  const int periods = std::max(1, std::min(10, 1300 / std::max(1, repeats)));
  const Loop loop{flight, std::chrono::milliseconds(7995), std::chrono::milliseconds(15), periods, 60};
  return measure_loop("hover",
                      "15 ms in the air, all tasks and sensors (250 us: 60 times real time) / plain Eigen model", loop,
                      std::min(repeats, 1300), [&] {
                        for (int i = 0; i < 3; ++i) plain.step(0.005);
                        return plain.height();
                      });
}

Figure measure_checkpoint(int repeats) {
  constexpr int in_a_row = 20;
  Session session = open(flight);
  session.run_until(std::chrono::seconds(8));
  const Archive::Bytes bytes = session.checkpoint().to_bytes();
  const auto save = [&] {
    session.run_for(std::chrono::milliseconds(15));
    return 1e6 / in_a_row * seconds_of([&] {
             for (int i = 0; i < in_a_row; ++i) keep(static_cast<double>(session.checkpoint().instant().count()));
           });
  };
  const auto copy = [&] {
    return 1e6 / in_a_row * seconds_of([&] {
             for (int i = 0; i < in_a_row; ++i) {
               const Archive::Bytes copied = bytes;
               keep(std::to_integer<int>(copied[bytes.size() / 2]));
             }
           });
  };
  Figure figure = compare("checkpoint", "checkpoint of the helicopter's run, in memory (50 us) / a copy of its bytes",
                          0, std::min(repeats, 1000), save, copy);
  figure.unit = "us";
  figure.goal = 50 / figure.floor;
  return figure;
}

#else

bool has_vehicles() { return false; }
bool has_graphs() { return false; }

Figure measure_dive(int) { throw std::logic_error("no vehicles are built"); }
Figure measure_dive_rigid(int) { throw std::logic_error("no vehicles are built"); }
Figure measure_hover_rigid(int) { throw std::logic_error("no vehicles are built"); }
Figure measure_hover(int) { throw std::logic_error("no vehicles are built"); }
Figure measure_checkpoint(int) { throw std::logic_error("no vehicles are built"); }

#endif

}  // namespace jarol::bench

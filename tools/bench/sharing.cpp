#include "tools/bench/sharing.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>

#include "graph/language/quantities.h"
#include "tools/bench/floors.h"
#include "tools/bench/graphs.h"
#include "tools/bench/timing.h"

namespace jarol::bench {
namespace {

// How many rounds of the small body take about so long.
std::uint32_t rounds_of(double seconds) {
  Filter state;
  Message in, out;
  double min = 1e300;
  for (int i = 0; i < 20; ++i)
    min = std::min(min, seconds_of([&] {
                     for (int r = 0; r < 10'000; ++r) pass_on(in, state, out);
                   }));
  return std::max(1U, static_cast<std::uint32_t>(seconds / (min / 10'000)));
}

// Two threads that have half of the bodies each and nothing to do with each other: the ideal.
std::function<double()> two_free_threads(int bodies, std::uint32_t rounds) {
  return [=] {
    const auto half = [=] {
      std::vector<Place> places(static_cast<std::size_t>(bodies) / 2);
      return seconds_of([&] {
        for (int repeat = 0; repeat < 10; ++repeat)
          for (Place& place : places)
            for (std::uint32_t r = 0; r < rounds; ++r) pass_on(place.in, place.state, place.out);
      });
    };
    double other = 0;
    std::thread thread([&] { other = half(); });
    const double own = half();
    thread.join();
    return 1e9 * std::max(own, other) / (10.0 * bodies);
  };
}

}  // namespace

// The worst of many widths and bodies: a second worker never hurts.
Figure measure_tiny(int repeats) {
  Figure worst;
  for (const int width : {2, 8, 50})
    for (const double body : {8e-9, 0.3e-6, 1e-6, 3e-6}) {
      const std::string text = layers(4, width, rounds_of(body));
      const std::int64_t rounds = std::max<std::int64_t>(3, static_cast<std::int64_t>(2e-3 / (body * 4 * width)));
      const auto run = [&](std::size_t workers) {
        auto graph = std::make_shared<GraphRun>(text, false, std::chrono::milliseconds(rounds), workers);
        for (int i = 0; i < 10; ++i) graph->nanoseconds();  // what is measured before it decides
        return [graph] { return graph->nanoseconds(); };
      };
      Figure figure = compare_medians("workers_2_tiny",
                                      "two workers / one, the worst of widths 2, 8, 50 and bodies of 8 ns to 3 us: " +
                                          std::to_string(width) + " wide, " + number_text(body * 1e9) + " ns",
                                      1.1, std::max(15, repeats), run(2), run(1));
      if (figure.ratio > worst.ratio) worst = std::move(figure);
    }
  return worst;
}

Figure measure_10us(int repeats) {
  const std::uint32_t rounds = rounds_of(10e-6);
  auto two = std::make_shared<GraphRun>(layers(4, 8, rounds), false, std::chrono::milliseconds(10), std::size_t{2});
  // 0.85 of the ideal: at most 1 / 0.85 of its time
  return compare_medians(
      "workers_2_10us", "4 layers of 8 bodies of 10 us, two workers / two free threads", 1 / 0.85,
      std::max(15, repeats), [two] { return two->nanoseconds(); }, two_free_threads(32, rounds));
}

}  // namespace jarol::bench

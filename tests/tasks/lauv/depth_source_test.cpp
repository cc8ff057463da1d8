#include "tasks/lauv/depth_source.h"

#include <doctest/doctest.h>

namespace {
using namespace jarol::tasks;

// A submarine whose gauges report at every step of 50 ms, exactly until set otherwise.
struct Gauges {
  Instruments i{};
  DepthSource source{};
  bool gauge_reports = true, pressure_reports = true;

  void read(double gauge, double pressure) {
    i.depth.value = gauge;
    i.pressure.value = 1013.25 + 98.1 * pressure;
  }
  void fix() { ++i.place.count; }
  // one a second
  double after_fixes(int fixes) {
    for (int k = 0; k < fixes; ++k) {
      fix();
      after(1);
    }
    return source.depth;
  }
  double after(double seconds) {
    for (int k = 0; k < static_cast<int>(20 * seconds + 0.5); ++k) {
      if (gauge_reports) ++i.depth.count;
      if (pressure_reports) ++i.pressure.count;
      source.take({.timeout = 2.5, .error = 0.6, .fix_depth = 0.15, .fix_error = 0.3, .enough = 3, .water = {}}, i,
                  0.05);
    }
    return source.depth;
  }
};

Gauges at(double gauge, double pressure) {
  Gauges made;
  made.read(gauge, pressure);
  made.after(1);
  return made;
}
}  // namespace

TEST_SUITE("tasks/depth_source") {
  TEST_CASE("98.1 hPa above the air's are a metre") {
    CHECK(calc_depth({}, 1013.25) == 0);
    CHECK(calc_depth({}, 1013.25 + 98.1) == doctest::Approx(1));
  }

  TEST_CASE("the gauge's depth counts, the pressure's from when the gauge has been silent for too long") {
    Gauges g = at(3, 3.1);
    CHECK(g.source.depth == 3);
    g.gauge_reports = false;
    g.read(3, 1);
    CHECK(g.after(2.4) == 3);
    CHECK(g.after(0.2) == doctest::Approx(1));
    // it comes back
    g.gauge_reports = true;
    g.read(0.9, 1);
    CHECK(g.after(0.05) == 0.9);
  }

  TEST_CASE("a gauge that is not fitted is not taken") {
    Gauges g;
    g.i.depth.count = -1;
    g.gauge_reports = false;
    g.read(0, 2);
    CHECK(g.after(0.05) == doctest::Approx(2));
  }

  TEST_CASE("where they differ by more than 60 cm the deeper one counts") {
    CHECK(at(3, 3.59).source.depth == 3);
    CHECK(at(3, 3.61).source.depth == doctest::Approx(3.61));
    CHECK(at(3, 2).source.depth == 3);
  }

  TEST_CASE("three fixes of GPS prove a deeper reading wrong, until a fix agrees") {
    Gauges g = at(3, 0.07);
    CHECK(g.source.depth == 3);
    CHECK(g.after_fixes(2) == 3);
    CHECK(g.after_fixes(1) == doctest::Approx(0.07));
    // under water there are no fixes, and the gauge is still the one that was wrong
    g.read(3, 1);
    CHECK(g.after(10) == doctest::Approx(1));
    g.read(0.1, 0.07);
    CHECK(g.after_fixes(1) == 0.1);
  }

  TEST_CASE("a fix that was late, or another's, takes no submarine for surfaced") {
    for (const bool both : {true, false}) {
      CAPTURE(both);
      Gauges g = at(6, 6);
      g.pressure_reports = both;
      g.after(3);
      CHECK(g.after_fixes(2) == 6);
      g.after(60);
      CHECK(g.after_fixes(1) == 6);
    }
  }

  TEST_CASE("gauge and pressure that agree are right, however many fixes there are") {
    Gauges g = at(3, 3.5);
    CHECK(g.after_fixes(10) == 3);
    g.read(3, 3.7);
    CHECK(g.after_fixes(1) == 0.15);
  }

  TEST_CASE("where nothing shows a smaller depth a reading is wrong only while fixes go on") {
    Gauges g = at(6, 6);
    g.pressure_reports = false;
    g.after(3);
    CHECK(g.after_fixes(3) == 0.15);
    CHECK(g.after(1.4) == 0.15);
    CHECK(g.after(0.2) == 6);
    g.read(7, 7);
    CHECK(g.after_fixes(2) == 7);
    CHECK(g.after_fixes(1) == 0.15);
  }

  TEST_CASE("a reading within 30 cm of where GPS works is believed beside fixes") {
    Gauges g = at(0.44, 0.44);
    g.pressure_reports = false;
    g.after(3);
    CHECK(g.after_fixes(5) == 0.44);
    g.read(0.46, 0.46);
    CHECK(g.after_fixes(3) == 0.15);
  }

  TEST_CASE("without either depth it stays where it was, and three fixes in a row bring it to the surface") {
    Gauges g = at(3, 3);
    g.gauge_reports = g.pressure_reports = false;
    CHECK(g.after(60) == 3);
    for (int late = 0; late < 4; ++late) {
      g.fix();
      CHECK(g.after(3) == 3);
    }
    CHECK(g.after_fixes(2) == 3);
    CHECK(g.after_fixes(1) == 0.15);
    CHECK(g.after(60) == 0.15);
  }

  TEST_CASE("what was at the surface already is no deeper for fixes") {
    Gauges g = at(0.07, 0.07);
    g.gauge_reports = g.pressure_reports = false;
    g.after(3);
    CHECK(g.after_fixes(3) == 0.07);
  }
}

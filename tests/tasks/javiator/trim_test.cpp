#include "tasks/javiator/trim.h"

#include <doctest/doctest.h>

using namespace jarol::tasks;

TEST_SUITE("tasks/trim") {
  TEST_CASE("it begins with the trim of the flight before; stores add what is estimated, a clear forgets all") {
    TrimKeys pressed;
    FlightDirective d;
    PilotCommand command{.kept_trim_roll = 0.02, .kept_trim_pitch = -0.01};
    trim(command, {.roll = 0.5}, default_max_trim, pressed, d);
    CHECK(d.trim_roll == 0.02);
    CHECK(d.trim_pitch == -0.01);
    ++command.trim_stores;
    trim(command, {.roll = 0.05, .pitch = 0.025}, default_max_trim, pressed, d);
    CHECK(d.trim_roll == doctest::Approx(0.07));
    CHECK(d.trim_pitch == doctest::Approx(0.015));
    trim(command, {.roll = 0.05, .pitch = 0.025}, default_max_trim, pressed, d);
    CHECK(d.trim_roll == doctest::Approx(0.07));
    ++command.trim_clears;
    trim(command, {.roll = 0.25}, default_max_trim, pressed, d);
    CHECK(d.trim_roll == 0);
    CHECK(d.trim_pitch == 0);
  }

  TEST_CASE("no more than 0.1 rad is level, stored or kept, to either side") {
    TrimKeys pressed;
    FlightDirective d;
    PilotCommand command{.kept_trim_roll = 0.3, .kept_trim_pitch = -0.3};
    trim(command, {}, default_max_trim, pressed, d);
    CHECK(d.trim_roll == 0.1);
    CHECK(d.trim_pitch == -0.1);
    ++command.trim_stores;
    trim(command, {.roll = 0.01, .pitch = 0.25}, default_max_trim, pressed, d);
    CHECK(d.trim_roll == 0.1);
    CHECK(d.trim_pitch == 0.1);
  }
}

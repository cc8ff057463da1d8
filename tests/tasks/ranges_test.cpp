// What each law's parameters may be: one beyond its range is refused by its name, unit and range.
#include <doctest/doctest.h>

#include "tasks/javiator/blind_observer.h"
#include "tasks/javiator/control.h"
#include "tasks/javiator/filter.h"
#include "tasks/javiator/flight_logic.h"
#include "tasks/javiator/motor_watch.h"
#include "tasks/lauv/guidance.h"
#include "tasks/lauv/navigation.h"
#include "tasks/lauv/supervisor.h"
#include "tests/beyond_range.h"

namespace {
using namespace jarol::tasks;
using jarol::tests::check_refused;
}  // namespace

TEST_SUITE("tasks/ranges") {
  TEST_CASE("the supervisor divides by no time, speed or mass that is 0") {
    check_refused<LauvSupervisor::Param>({
        {{"fix_depth"}, "a double [m] from 0 to 10", "-0.1"},
        {{"levelling", "min_speed"}, "a double [m/s] from 0.01 to 10", "0"},
        {{"levelling", "heave_time"}, "a double [s] from 0.1 to 1000", "0"},
        {{"reckoning", "angle_time"}, "a double [s] from 0.1 to 1000", "0"},
        {{"reckoning", "floor_time"}, "a double [s] from 0.1 to 10000", "0"},
        {{"reckoning", "drag_growth"}, "a double [s/m] from 0 to 100", "-1"},
        {{"reckoning", "water", "density"}, "a double [kg/m^3] from 500 to 2000", "0"},
        {{"surge_mass"}, "a double [kg] from 0.1 to 10000", "0"},
    });
  }

  TEST_CASE("navigation knows water and air, asks for a fix at least, and has no place without an error") {
    check_refused<LauvNavigation::Param>({
        {{"surface_fixes"}, "an int64 from 1 to 1000", "0"},
        {{"fix_error"}, "a double [m] from 0.001 to 1000", "0"},
        {{"range_error"}, "a double [m] from 0.001 to 1000", "0"},
        {{"water", "density"}, "a double [kg/m^3] from 500 to 2000", "1.025"},
        {{"water", "air_pressure"}, "a double [hPa] from 0 to 2000", "101325"},
    });
  }

  TEST_CASE("guidance divides by no lookahead, rate or speed that is 0, and prepares no turn back") {
    check_refused<LauvGuidance::Param>({
        {{"lookahead"}, "a double [m] from 0.01 to 10000", "0"},
        {{"turn_rate"}, "a double [rad/s] from 0.001 to 10", "0"},
        {{"joins"}, "a double from 0 to 1000", "-1"},
        {{"max_turn"}, "a double [rad] from 0 to 2.9670597283903604", "180deg"},
        {{"max_drift"}, "a double from 0 to 1", "1.1"},
        {{"min_speed"}, "a double [m/s] from 0.001 to 10", "0"},
        {{"station", "back"}, "a double from 0 to 1", "1.5"},
        {{"station", "edge"}, "a double from 1 to 1000", "0.5"},
    });
  }

  TEST_CASE("the filter learns by parts of at most 1, and knows walls at distances") {
    check_refused<JaviatorFilter::Param>({
        {{"age", "battery_time"}, "a double [s] from 0.1 to 1000", "0"},
        {{"drift", "rest", "bias_part"}, "a double from 0 to 1", "1.1"},
        {{"drift", "rest", "place_part"}, "a double from 0 to 1", "1.1"},
        {{"drift", "rest", "pressure_part"}, "a double from 0 to 1", "1.1"},
        {{"drift", "rest", "steps"}, "a uint32 from 2 to 10000", "1"},
        {{"drift", "rest", "max_step"}, "a double [Pa] from 0 to 10000", "-1"},
        {{"room", "sight", "corner"}, "a double [m] from 0 to 100", "-1"},
        {{"room", "sight", "place_error"}, "a double [m] from 0 to 100", "-1"},
        {{"room", "sight", "grazing"}, "a double from 0 to 1", "2"},
        {{"unfelt", "plane", "reach"}, "a double [m] from 0 to 100", "-1"},
        {{"unfelt", "plane", "jump"}, "a double [m] from 0 to 10", "-1"},
        {{"unfelt", "climb", "push"}, "a double [m/s^2] from 0.001 to 1000", "0"},
        {{"unfelt", "climb", "noise"}, "a double [m] from 1e-06 to 1", "0"},
        {{"unfelt", "stand", "foot"}, "a double [m] from 0.01 to 10", "0"},
    });
  }

  TEST_CASE("max_trim and stop_time are refused below 0") {
    check_refused<FlightLogic::Param>({
        {{"max_trim"}, "a double [rad] from 0 to 1.5707963267948966", "-0.1"},
        {{"way", "stop_time"}, "a double [s] from 0 to 100", "-1"},
        {{"high"}, "a double [m] from 0 to 0.5", "2"},
    });
  }

  TEST_CASE("signals are scaled about those of the reference voltage, and what is divided by is not 0") {
    check_refused<MotorMixer::Param>({
        {{"battery", "min"}, "a double from 0.1 to 1", "0"},
        {{"battery", "max"}, "a double from 1 to 10", "0.9"},
    });
    check_refused<MotorWatch::Param>({
        {{"of_one_sample"}, "a double from 0 to 1", "1.1"},
        {{"min_thrust"}, "a double from 0.01 to 1", "0"},
        {{"min_effectiveness"}, "a double from 0.01 to 1", "0"},
        {{"battery", "min"}, "a double from 0.1 to 1", "0"},
    });
  }

  TEST_CASE("the observer without an IMU divides by no thrust or time that is 0") {
    check_refused<BlindObserver::Param>({
        {{"min_thrust"}, "a double from 0.01 to 1", "0"},
        {{"gust_time"}, "a double [s] from 0.02 to 1000", "0"},
        {{"start", "place"}, "a double [m] from 0 to 10", "-1"},
        {{"start", "speed"}, "a double [m/s] from 0 to 10", "-1"},
        {{"start", "lean"}, "a double [rad] from 0 to 1", "-1"},
        {{"start", "rate"}, "a double [rad/s] from 0 to 10", "-1"},
        {{"start", "wind_apart"}, "a double from 0 to 10", "-1"},
        {{"start", "wind_width"}, "a double from 0 to 10", "-1"},
        {{"sonars", "arm"}, "a double [m] from 0.01 to 10", "0"},
        {{"sonars", "plane", "reach"}, "a double [m] from 0 to 100", "-1"},
        {{"sonars", "plane", "jump"}, "a double [m] from 0 to 10", "-1"},
        {{"sonars", "noise"}, "a double [rad] from 1e-04 to 1", "0"},
        {{"sonars", "age"}, "a double [s] from 0 to 1", "-1"},
        {{"sonars", "mean_time"}, "a double [s] from 1 to 1000", "0"},
        {{"sonars", "patience"}, "a double [s] from 0 to 1", "-1"},
    });
  }
}

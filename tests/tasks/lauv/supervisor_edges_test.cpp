// Each limit and time-out of the supervisor, just below and just above, and what it does then.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>

#include "tests/tasks/lauv/watched_submarine.h"

namespace {
using namespace jarol;
using namespace jarol::tasks;
using tests::Change;
using tests::unchanged;
using tests::WatchedSubmarine;
constexpr double degrees = std::numbers::pi / 180;

// Steps of 50 ms after a calm second until the alarm; 0: none within 100 s.
int steps_to_alarm(const Change& change, Alarm expected) {
  WatchedSubmarine w;
  w.run(20, unchanged);
  const int steps = w.steps_to_alarm(change);
  CHECK(w.out.condition.alarm == (steps > 0 ? expected : Alarm::none));
  return steps;
}
}  // namespace

TEST_SUITE("tasks/lauv_supervisor/edges") {
  TEST_CASE("GPS is lost after four seconds at the surface, and the surface ends at 15 cm, as far down as GPS works") {
    const auto at = [](double depth) {
      return [depth](LauvSupervisor::In& in) {
        in.instruments.depth.value = depth;
        in.instruments.pressure.value = 1013.25 + depth * 98.1;
        in.instruments.altitude.value = 50 - depth;
      };
    };
    const int steps = steps_to_alarm(at(0.149), Alarm::gps);
    CHECK((steps == 80 || steps == 81));
    CHECK(steps_to_alarm(at(0.151), Alarm::gps) == 0);
  }

  TEST_CASE("each limit alarms at once when it is exceeded, and not before") {
    struct Case {
      double below, above;
      void (*set)(LauvSupervisor::In&, double);
      Alarm alarm;
    };
    const Case cases[] = {
        {5, 5.001, [](LauvSupervisor::In& in, double x) { in.contact.silence = x; }, Alarm::operator_lost},
        {0.5, 0.501, [](LauvSupervisor::In& in, double x) { in.instruments.leak.value = x; }, Alarm::leak},
        {12, 12.001,
         [](LauvSupervisor::In& in, double x) {
           in.instruments.depth.value = x;
           in.instruments.pressure.value = 1013.25 + x * 98.1;
           in.instruments.altitude.value = 50 - x;
         },
         Alarm::depth_limit},
        {-2, -1.999, [](LauvSupervisor::In& in, double x) { in.instruments.altitude.value = -x; },
         Alarm::altitude_limit},
        {50 * degrees, 50.01 * degrees, [](LauvSupervisor::In& in, double x) { in.instruments.attitude.y = x; },
         Alarm::pitch_limit},
        {50 * degrees, 50.01 * degrees, [](LauvSupervisor::In& in, double x) { in.instruments.attitude.y = -x; },
         Alarm::pitch_limit},
        {-20, -19.999, [](LauvSupervisor::In& in, double x) { in.instruments.voltage.value = -x; },
         Alarm::voltage_limit}};
    for (const Case& c : cases) {
      WatchedSubmarine w;
      w.run(20, unchanged);
      CHECK(w.run(1, [&](LauvSupervisor::In& in) { c.set(in, c.below); }) == Alarm::none);
      CHECK(w.run(1, [&](LauvSupervisor::In& in) { c.set(in, c.above); }) == c.alarm);
    }
  }

  TEST_CASE("an instrument that differs from what another knows alarms, by its limit and after its time") {
    struct Case {
      double below, above;
      int steps;  // of 50 ms, to the alarm
      void (*set)(Instruments&, double);
      Alarm alarm;
    };
    const Case cases[] = {
        {0.299, 0.301, 20, [](Instruments& i, double x) { i.depth.value = 5 + x; }, Alarm::depth_gauge},
        {0.299, 0.301, 20, [](Instruments& i, double x) { i.depth.value = 5 - x; }, Alarm::depth_gauge},
        {14.9 * degrees, 15.1 * degrees, 20, [](Instruments& i, double x) { i.heading.value = x; }, Alarm::heading},
        {14.9 * degrees, 15.1 * degrees, 20, [](Instruments& i, double x) { i.heading.value = -x; }, Alarm::heading},
        {2.49, 2.51, 20, [](Instruments& i, double x) { i.forces.x = x; }, Alarm::forces},
        {2.49, 2.51, 20, [](Instruments& i, double x) { i.forces.y = -x; }, Alarm::forces},
        {2.49, 2.51, 20, [](Instruments& i, double x) { i.forces.z = -9.81 + x; }, Alarm::forces},
        {0.499, 0.501, 60, [](Instruments& i, double x) { i.velocity.x = x; }, Alarm::speed},
        {0.499, 0.501, 60, [](Instruments& i, double x) { i.velocity.x = -x; }, Alarm::speed}};
    for (const Case& c : cases) {
      CAPTURE(c.above);
      CHECK(steps_to_alarm([&](LauvSupervisor::In& in) { c.set(in.instruments, c.below); }, c.alarm) == 0);
      const int steps = steps_to_alarm([&](LauvSupervisor::In& in) { c.set(in.instruments, c.above); }, c.alarm);
      CHECK(steps >= c.steps);
      CHECK(steps <= c.steps + 1);
    }
  }

  TEST_CASE("gravity in a rolled and pitched hull is what its accelerometers have to feel") {
    for (const double phi : {-0.5, 0.5}) {
      for (const double theta : {-0.4, 0.4}) {
        const Eigen::Matrix3d R_nb =
            (Eigen::AngleAxisd(theta, Eigen::Vector3d::UnitY()) * Eigen::AngleAxisd(phi, Eigen::Vector3d::UnitX()))
                .toRotationMatrix();
        const Eigen::Vector3d felt_b = R_nb.transpose() * Eigen::Vector3d(0, 0, -9.81);
        const auto lies = [&](double error) {
          WatchedSubmarine w;
          return w.run(60, [&](LauvSupervisor::In& in) {
            in.instruments.attitude = {phi, theta, 0, in.instruments.attitude.count};
            in.instruments.forces = {felt_b.x(), felt_b.y() + error, felt_b.z(), in.instruments.forces.count};
            in.instruments.altitude.value = 45 / (std::cos(phi) * std::cos(theta));  // along the hull's own down
          });
        };
        CHECK(lies(0) == Alarm::none);
        CHECK(lies(2.49) == Alarm::none);
        CHECK(lies(-2.51) == Alarm::forces);
      }
    }
  }

  TEST_CASE("a sea floor that steps by more than a metre and a half is the altimeter's, less is the floor's") {
    // the step decays with half a minute: what begins a little above the limit is above it for a second
    CHECK(steps_to_alarm([](LauvSupervisor::In& in) { in.instruments.altitude.value = 45 + 1.49; }, Alarm::altimeter) ==
          0);
    const int steps =
        steps_to_alarm([](LauvSupervisor::In& in) { in.instruments.altitude.value = 45 - 1.6; }, Alarm::altimeter);
    CHECK((steps == 20 || steps == 21));
  }

  TEST_CASE("an attitude that the rates do not explain alarms, one that they explain does not") {
    // turned at once by 8 degrees: 2 s later a third of the difference is left, after one second more than 6 of 8
    const Change jump = [](LauvSupervisor::In& in) { in.instruments.attitude.y = 12 * degrees; };
    CHECK(steps_to_alarm(jump, Alarm::attitude) > 0);
    WatchedSubmarine w;
    double theta = 0;
    w.run(20, unchanged);
    const Alarm alarm = w.run(40, [&](LauvSupervisor::In& in) {
      theta += 0.05 * 0.1;
      in.instruments.attitude.y = theta;
      in.instruments.rates.y = 0.1;
      in.instruments.forces.x = 9.81 * std::sin(theta);
      in.instruments.forces.z = -9.81 * std::cos(theta);
    });
    CHECK(alarm == Alarm::none);
  }

  TEST_CASE("the propeller's speed is what its thrust and the drag leave: a log that agrees does not alarm") {
    // 300 rad/s would be 18.9 N, bounded to 14.4 N; 2.4 N s/m u (1 + u) = 14.4 N at u = 2
    const double u = 2;
    WatchedSubmarine w;
    const Change going = [&](LauvSupervisor::In& at) {
      at.instruments.rpm.value = 300 * 30 / std::numbers::pi;
      at.instruments.velocity.x = u;
    };
    CHECK(w.run(4000, going) == Alarm::none);
    CHECK(w.state.speed == doctest::Approx(u).scale(0).epsilon(1e-6));
    // below the bound: 150 rad/s are 4.725 N
    const double slow = (-1 + std::sqrt(1 + 4 * 4.725 / 2.4)) / 2;
    WatchedSubmarine v;
    v.run(4000, [&](LauvSupervisor::In& at) {
      at.instruments.rpm.value = 150 * 30 / std::numbers::pi;
      at.instruments.velocity.x = slow;
    });
    CHECK(v.state.speed == doctest::Approx(slow).scale(0).epsilon(1e-6));
    // and 19 kg give the first step from rest: 14.4 N for 50 ms
    WatchedSubmarine first;
    first.run(1, [&](LauvSupervisor::In& at) { at.instruments.rpm.value = 300 * 30 / std::numbers::pi; });
    CHECK(first.state.speed == doctest::Approx(0.05 * 14.4 / 19));
  }

  TEST_CASE("what it does then: it climbs by its propeller, or stops it where steering or power are in doubt") {
    struct Case {
      void (*set)(LauvSupervisor::In&);
      Alarm alarm;
      bool climbs;
    };
    const Case cases[] = {
        {[](LauvSupervisor::In& in) { in.contact.silence = 6; }, Alarm::operator_lost, true},
        {[](LauvSupervisor::In& in) { in.instruments.depth.value = 13; }, Alarm::depth_limit, true},
        {[](LauvSupervisor::In& in) { in.instruments.altitude.value = 1; }, Alarm::altitude_limit, true},
        {[](LauvSupervisor::In& in) { in.instruments.leak.value = 1; }, Alarm::leak, true},
        {[](LauvSupervisor::In& in) { in.instruments.depth.count = 20; }, Alarm::depth_gauge, true},
        {[](LauvSupervisor::In& in) { in.instruments.heading.count = 20; }, Alarm::heading, true},
        {[](LauvSupervisor::In& in) { in.instruments.altitude.count = 20; }, Alarm::altimeter, true},
        {[](LauvSupervisor::In& in) { in.instruments.conductivity.count = 20; }, Alarm::ctd, true},
        {[](LauvSupervisor::In& in) { in.instruments.current.count = 20; }, Alarm::battery, true},
        {[](LauvSupervisor::In& in) { in.instruments.voltage.value = 19; }, Alarm::voltage_limit, false},
        {[](LauvSupervisor::In& in) { in.instruments.attitude.y = 1; }, Alarm::pitch_limit, false},
        {[](LauvSupervisor::In& in) { in.instruments.attitude.count = 20; }, Alarm::attitude, false},
        {[](LauvSupervisor::In& in) { in.instruments.forces.count = 20; }, Alarm::forces, false},
        {[](LauvSupervisor::In& in) { in.instruments.velocity.count = 20; }, Alarm::speed, false}};
    for (const Case& c : cases) {
      CAPTURE(static_cast<int>(c.alarm));
      WatchedSubmarine w;
      w.run(20, unchanged);
      CHECK(w.run(52, c.set) == c.alarm);
      CHECK(w.out.setpoint.speed == (c.climbs ? 1 : 0));
      CHECK(w.out.setpoint.depth == (c.climbs ? -1000 : 0));
      CHECK(w.out.setpoint.heading == 1.5);
    }
  }

  TEST_CASE("a climb on which it sinks by a metre and a half ends, unless it is the gauge that is in doubt") {
    const auto speed_at = [](double sunk, bool gauge_is_right) {
      WatchedSubmarine w;
      w.run(20, unchanged);
      w.run(1, [](LauvSupervisor::In& in) { in.instruments.leak.value = 1; });
      if (!gauge_is_right) w.state.alarm = Alarm::depth_gauge;
      w.run(1, [&](LauvSupervisor::In& in) { in.instruments.depth.value = 5 + sunk; });
      w.run(1, unchanged);  // and it stays off
      return w.out.setpoint.speed;
    };
    CHECK(speed_at(1.49, true) == 1);
    CHECK(speed_at(1.51, true) == 0);
    CHECK(speed_at(3, false) == 1);
  }

  TEST_CASE("without a depth gauge it is as deep as the pressure says: GPS is not waited for, and limits hold") {
    const auto alarm_at = [](double depth) {
      WatchedSubmarine w;
      return w.run(100, [&](LauvSupervisor::In& in) {
        in.instruments.depth = {0, -1};
        in.instruments.pressure.value = 1013.25 + 98.1 * depth;
        in.instruments.altitude.count = -1;
      });
    };
    CHECK(alarm_at(0.1) == Alarm::gps);
    CHECK(alarm_at(11.9) == Alarm::none);
    CHECK(alarm_at(12.1) == Alarm::depth_limit);
  }

  TEST_CASE("a climb ends after a minute") {
    WatchedSubmarine w;
    const Change leak = [](LauvSupervisor::In& in) { in.instruments.leak.value = 1; };
    w.run(1199, leak);  // 59.95 s
    CHECK(w.out.setpoint.speed == 1);
    w.run(3, leak);
    CHECK(w.out.setpoint.speed == 0);
  }
}

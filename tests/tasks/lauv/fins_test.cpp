// Fins that fail: what finds them, and the moments that the other three give, from forces and levers.
#include "tasks/lauv/fins.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tasks/lauv/control.h"
#include "tasks/lauv/supervisor.h"
#include "tests/tasks/calm_submarine.h"
#include "tests/tasks/lauv/every_50_ms.h"

namespace {
using namespace jarol;
using namespace jarol::tasks;
using namespace std::chrono_literals;

using tests::every_50_ms;
using Fins = std::array<double, 4>;
constexpr double limit = 25 * degree;

// What the four fins turn with, per lift of one by its angle: 0.4 m behind, 0.08 m from the axis; lift of rudders to
// starboard, of elevators upwards (z is down).
Eigen::Vector3d moment_of(const Fins& fins) {
  const Eigen::Vector3d places[] = {{-0.4, 0, 0.08}, {-0.4, -0.08, 0}, {-0.4, 0.08, 0}, {-0.4, 0, -0.08}};
  const Eigen::Vector3d lifts[] = {{0, 1, 0}, {0, 0, -1}, {0, 0, -1}, {0, 1, 0}};
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < 4; ++i) sum += places[i].cross(std::clamp(fins[i], -limit, limit) * lifts[i]);
  return sum;
}

FinCondition stuck_at(std::size_t fin, double angle) {
  FinCondition fins;
  fins.states.fill(FinState::follows);
  fins.states[fin] = FinState::stuck;
  fins.angles[fin] = angle;
  return fins;
}

Fins allocated(double pitch, double yaw, const FinCondition& fins) {
  FaultTolerantAllocator::Out out;
  FaultTolerantAllocator::run({}, every_50_ms, {{pitch}, {yaw}, {0.5}, fins}, out);
  CHECK(out.actuation.thruster == 0.5);
  return out.actuation.fins;
}

Fins sound(double pitch, double yaw) {
  FinAllocator::Out out;
  FinAllocator::run(every_50_ms, {{pitch}, {yaw}, {0.5}}, out);
  return out.actuation.fins;
}

bool is_same(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return (a - b).norm() < 1e-12; }

struct Watch {
  FinWatch::Param param{};
  FinWatch::State state{};
  FinWatch::In in{};
  FinWatch::Out out{};

  // One step; a reading of each servo.
  void step(const Fins& commanded, const Fins& angles) {
    for (std::size_t i = 0; i < 4; ++i) in.servos.fins[i] = {angles[i], commanded[i], in.servos.fins[i].count + 1};
    FinWatch::run(param, every_50_ms, in, state, out);
  }
  void silent_step() { FinWatch::run(param, every_50_ms, in, state, out); }
};

// Steps of 50 ms until it is found that this fin is further out by `error` than where it is sent; 0: not in 20 s.
int steps_to_stuck(std::size_t fin, double error) {
  Watch w;
  for (int i = 0; i < 20; ++i) w.step({0.1, 0.1, 0.1, 0.1}, {0.1, 0.1, 0.1, 0.1});
  Fins angles{0.1, 0.1, 0.1, 0.1};
  angles[fin] += error;
  for (int step = 1; step <= 400; ++step) {
    w.step({0.1, 0.1, 0.1, 0.1}, angles);
    for (std::size_t other = 0; other < 4; ++other)
      if (other != fin) CHECK(w.out.fins.states[other] == FinState::follows);
    if (w.out.fins.states[fin] == FinState::follows) continue;
    CHECK(w.out.fins.states[fin] == FinState::stuck);
    CHECK(w.out.fins.angles[fin] == angles[fin]);
    return step;
  }
  return 0;
}
}  // namespace

TEST_SUITE("tasks/lauv_fins") {
  TEST_CASE("three degrees off for three tenths of a second is stuck, less is not, for each fin to each side") {
    for (std::size_t fin = 0; fin < 4; ++fin)
      for (const double side : {-1.0, 1.0}) {
        CAPTURE(fin);
        CHECK(steps_to_stuck(fin, side * 2.99 * degree) == 0);
        const int steps = steps_to_stuck(fin, side * 3.01 * degree);
        // the sum of six steps may lie a rounding above or below 0.3
        CHECK(steps >= 6);
        CHECK(steps <= 7);
      }
  }

  TEST_CASE("a servo that turns as fast as is said follows whatever it is commanded, a slower one does not") {
    const auto follows = [](double rate, double said) {
      Watch w;
      w.param.servo_rate = said;
      double angle = 0;
      for (int i = 0; i < 400; ++i) {
        const double commanded = (i / 20) % 2 == 0 ? limit : -limit;
        angle += std::clamp(commanded - angle, -rate * 0.05, rate * 0.05);
        w.step({commanded, 0, 0, 0}, {angle, 0, 0, 0});
      }
      return w.out.fins.states[0] == FinState::follows;
    };
    CHECK(follows(200 * degree, 200 * degree));
    CHECK(follows(1000 * degree, 200 * degree));
    CHECK_FALSE(follows(60 * degree, 200 * degree));
    CHECK(follows(60 * degree, 60 * degree));
  }

  TEST_CASE("a command beyond what servos can do is no failure of theirs") {
    Watch w;
    for (int i = 0; i < 100; ++i) w.step({1.5, 0, 0, 0}, {max_fin_angle, 0, 0, 0});
    CHECK(w.out.fins.states[0] == FinState::follows);
  }

  TEST_CASE("a fin is found stuck where the command swings to and fro across it") {
    Watch w;
    int steps = 0;
    for (; steps < 200 && w.out.fins.states[2] != FinState::stuck; ++steps)
      w.step({0, 0, 12 * degree * std::sin(2 * steps * 0.05 * 2 * std::numbers::pi), 0}, {0, 0, 0, 0});
    CHECK(steps < 40);
  }

  TEST_CASE("of a vehicle that reports no servo, only its propeller, no fin is checked") {
    Watch w;
    w.in.servos.propeller.count = 1;
    w.in.servos.fins[1] = {0, 0.4, 0};
    for (int i = 0; i < 1000; ++i) w.silent_step();
    for (const FinState state : w.out.fins.states) CHECK(state == FinState::unknown);
  }

  TEST_CASE("a servo that never reports is silent 2.5 s after another has, unless it is not fitted") {
    Watch w;
    w.in.servos.fins[0].count = 1;
    w.in.servos.fins[2].count = -1;
    for (int i = 0; i < 49; ++i) w.silent_step();
    using enum FinState;
    CHECK(w.out.fins.states == std::array{follows, unknown, unknown, unknown});
    for (int i = 0; i < 3; ++i) w.silent_step();
    CHECK(w.out.fins.states == std::array{silent, silent, unknown, silent});
  }

  TEST_CASE("a servo that reports late begins where it is, and is not stuck") {
    Watch w;
    w.in.servos.fins[0].count = 1;
    for (int i = 0; i < 60; ++i) w.silent_step();
    CHECK(w.out.fins.states[1] == FinState::silent);
    for (int i = 0; i < 40; ++i) w.step({0, 0.4, 0, 0}, {0, 0.4, 0, 0});
    CHECK(w.out.fins.states[1] == FinState::follows);
  }

  TEST_CASE("a servo that reports no more is silent, until it does again") {
    Watch w;
    for (int i = 0; i < 20; ++i) w.step({}, {});
    for (int i = 0; i < 49; ++i) w.silent_step();
    CHECK(w.out.fins.states[3] == FinState::follows);
    w.silent_step();
    w.silent_step();
    CHECK(w.out.fins.states[3] == FinState::silent);
    w.step({}, {});
    CHECK(w.out.fins.states[3] == FinState::follows);
  }

  TEST_CASE("2.5 s after a vehicle is heard of which no servo is, it is said that no fin is checked, until one is") {
    LauvSupervisor::State state;
    LauvSupervisor::Out out;
    const auto run = [&](std::int64_t k, FinState first) {
      LauvSupervisor::In in = tests::calm_submarine(k);
      in.fins.states[0] = first;
      LauvSupervisor::run({}, every_50_ms, in, state, out);
      if (k > 0) CHECK(out.condition.alarm == Alarm::none);
      return out.condition.fins;
    };
    using enum FinState;
    for (int i = 0; i < 60; ++i) CHECK(run(0, unknown) == FinCheck::checked);  // the vehicle comes late
    for (int k = 1; k < 50; ++k) CHECK(run(k, unknown) == FinCheck::checked);
    for (int k = 50; k < 53; ++k) run(k, unknown);
    CHECK(out.condition.fins == FinCheck::unchecked);
    CHECK(run(53, follows) == FinCheck::checked);
  }

  TEST_CASE("an old reading says nothing of a new command") {
    Watch w;
    for (int i = 0; i < 20; ++i) w.step({}, {});
    for (ServoReading& servo : w.in.servos.fins) servo.commanded = 0.4;
    for (int i = 0; i < 40; ++i) w.silent_step();
    for (const FinState state : w.out.fins.states) CHECK(state == FinState::follows);
  }

  TEST_CASE("a stuck fin stays stuck where it was found, until the operator stops everything: then it is tried anew") {
    Watch w;
    for (int i = 0; i < 20; ++i) w.step({}, {0.2, 0, 0, 0});
    CHECK(w.out.fins.states[0] == FinState::stuck);
    for (int i = 0; i < 100; ++i) w.step({0.2, 0, 0, 0}, {0.3, 0, 0, 0});
    CHECK(w.out.fins.states[0] == FinState::stuck);
    CHECK(w.out.fins.angles[0] == 0.2);
    w.in.contact.stops = 1;
    w.step({}, {0.3, 0, 0, 0});
    CHECK(w.out.fins.states[0] == FinState::follows);
    for (int i = 0; i < 10; ++i) w.step({}, {0.3, 0, 0, 0});
    CHECK(w.out.fins.states[0] == FinState::stuck);
    CHECK(w.out.fins.angles[0] == 0.3);
  }

  TEST_CASE("while no fin is stuck the fins are those of the plain allocator") {
    for (const FinState state : {FinState::unknown, FinState::follows, FinState::silent}) {
      FinCondition fins;
      fins.states.fill(state);
      fins.angles = {0.1, 0.2, 0.3, 0.4};
      for (const double pitch : {-0.43, 0.0, 0.1})
        for (const double yaw : {-0.2, 0.0, 0.43}) CHECK(allocated(pitch, yaw, fins) == sound(pitch, yaw));
    }
  }

  TEST_CASE("with any fin stuck the other three turn as all four would, and do not roll") {
    for (std::size_t fin = 0; fin < 4; ++fin)
      for (const double angle : {-0.1, -0.05, 0.0, 0.1})
        for (const double pitch : {-0.1, 0.0, 0.15})
          for (const double yaw : {-0.15, 0.0, 0.1}) {
            CAPTURE(fin);
            CAPTURE(angle);
            const Fins fins = allocated(pitch, yaw, stuck_at(fin, angle));
            CHECK(fins[fin] == angle);
            CHECK(is_same(moment_of(fins), moment_of(sound(pitch, yaw))));
          }
  }

  TEST_CASE("a demand comes before the roll: what room it leaves is for that, and no fin is sent beyond its limit") {
    for (std::size_t fin = 0; fin < 4; ++fin)
      for (const double angle : {-limit, limit})
        for (const double other_demand : {-limit, -0.3, 0.0, 0.2, limit}) {
          CAPTURE(fin);
          const bool is_rudder = fin == 0 || fin == 3;
          const double pitch = is_rudder ? other_demand : 0, yaw = is_rudder ? 0 : other_demand;
          const Fins fins = allocated(pitch, yaw, stuck_at(fin, angle));
          for (const double each : fins) CHECK(std::abs(each) <= limit + 1e-12);
          const Eigen::Vector3d moment = moment_of(fins);
          CHECK(moment.tail<2>().isApprox(moment_of(sound(pitch, yaw)).tail<2>(), 1e-9));
          // a pair that stands apart by twice the limit rolls; what is left after the other pair's room
          CHECK(std::abs(moment.x()) == doctest::Approx(2 * 0.08 * std::abs(other_demand)).epsilon(1e-9));
        }
  }

  TEST_CASE("what one fin cannot give is left out: its partner goes to its limit") {
    const Fins fins = allocated(0, limit, stuck_at(0, 0.1));
    CHECK(fins[3] == -limit);
    CHECK(allocated(-limit, 0, stuck_at(2, -0.1))[1] == limit);
  }

  TEST_CASE("a fin beyond the angle that lifts most counts as one that is there") {
    for (std::size_t fin = 0; fin < 4; ++fin) {
      Fins at = allocated(0, 0, stuck_at(fin, max_fin_angle)), same = allocated(0, 0, stuck_at(fin, limit));
      CHECK(at[fin] == max_fin_angle);
      at[fin] = same[fin];
      CHECK(at == same);
    }
  }

  TEST_CASE(
      "where both of a pair are stuck they are sent what is demanded, and each that is left does for its own pair") {
    FinCondition one_pair = stuck_at(0, 0.1);
    one_pair.states[3] = FinState::stuck;
    one_pair.angles[3] = -0.05;
    const Fins fins = allocated(0.1, 0.2, one_pair);
    CHECK(fins[0] == sound(0.1, 0.2)[0]);
    CHECK(fins[3] == sound(0.1, 0.2)[3]);
    // what turns it where they stand as they report
    const Fins standing{0.1, fins[1], fins[2], -0.05};
    CHECK(moment_of(standing).x() == doctest::Approx(0));
    CHECK(moment_of(standing).y() == doctest::Approx(moment_of(sound(0.1, 0)).y()));

    FinCondition all_off = stuck_at(0, 0.2);
    all_off.states.fill(FinState::stuck);
    all_off.angles.fill(0.2);
    CHECK(allocated(0.1, 0.2, all_off) == sound(0.1, 0.2));

    FinCondition one_of_each = stuck_at(3, 0.1);
    one_of_each.states[1] = FinState::stuck;
    one_of_each.angles[1] = -0.05;
    const Eigen::Vector3d moment = moment_of(allocated(0.1, 0.12, one_of_each));
    CHECK(moment.tail<2>().isApprox(moment_of(sound(0.1, 0.12)).tail<2>(), 1e-9));
  }
}

// How the helicopter leans when its IMU is lost, against a plant of its own: a body that is pushed where it leans.
#include "tasks/javiator/blind_observer.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "tests/tasks/javiator/every_15_ms.h"

namespace {
using namespace jarol::tasks;
using jarol::tests::dt;
using jarol::tests::g_earth;
using jarol::tests::tick;

constexpr double quarter = std::numbers::pi / 2;

struct Blind {
  BlindObserver::Param param{};
  BlindObserver::State state{};
  BlindObserver::Out out{};
  BlindObserver::In in{.estimate = {.altitude = 100, .lift = g_earth, .rates_known = true}, .lift = {1}};

  const BlindMotion& run(int periods = 1) {
    for (int i = 0; i < periods; ++i) BlindObserver::run(param, tick, in, state, out);
    return out.motion;
  }
  void lose_imu() {
    run(400);
    in.estimate.rates_known = false;
  }
};

// One axis of a body in calm air, whose place a ray measures to a wall `range` m ahead.
struct PushedBody {
  double place = 0, speed = 0, lean = 0;
  double range = 8;

  void run(const BlindObserver::Param& p) {
    constexpr int parts = 15;
    for (int i = 0; i < parts; ++i) {
      place += speed * dt / parts;
      speed += (g_earth * std::tan(lean) - p.drag * speed) * dt / parts;
    }
  }
  // with the lean that is taken for true
  PlaceFix fix(double taken) const {
    const double ray = (range - place) / std::cos(lean);
    return {.place = range - ray * std::cos(taken), .slope = ray * std::sin(taken), .range = ray, .is_new = true};
  }
};
}  // namespace

TEST_SUITE("tasks/blind_observer") {
  TEST_CASE("while the IMU reports it says where that will be a period on") {
    Blind b;
    b.in.estimate.x = 1;
    b.in.estimate.v_x = 0.5;
    b.in.estimate.pitch = -0.1;
    b.in.estimate.q = -0.2;
    b.in.estimate.yaw = 0.3;
    b.in.estimate.r = 0.05;
    b.in.estimate.drag_x = -g_earth * 0.1;
    const BlindMotion& m = b.run(400);
    CHECK(m.x == doctest::Approx(1 + 0.5 * dt).epsilon(1e-4).scale(0));
    CHECK(m.v_x == doctest::Approx(0.5).epsilon(0.01).scale(0));
    CHECK(m.pitch == doctest::Approx(-0.1 - 0.2 * dt).epsilon(0.01).scale(0));
    CHECK(m.yaw == doctest::Approx(0.3 + 0.05 * dt));
    CHECK(m.known);
  }

  TEST_CASE("it is pushed where it leans, whatever its heading") {
    struct Case {
      double heading, roll, pitch, north, east;
    };
    for (const Case& c : {Case{0, 0, -0.1, 1, 0}, Case{0, 0.1, 0, 0, 1}, Case{quarter, 0.1, 0, -1, 0},
                          Case{quarter, 0, -0.1, 0, 1}, Case{2 * quarter, 0, -0.1, -1, 0}}) {
      Blind b;
      b.in.estimate.heading = c.heading;
      b.in.estimate.roll = c.roll;
      b.in.estimate.pitch = c.pitch;
      const BlindMotion& m = b.run();
      CHECK(m.roll == doctest::Approx(c.roll));
      CHECK(m.pitch == doctest::Approx(c.pitch));
      CHECK(m.v_x == doctest::Approx(c.north * g_earth * 0.1 * dt));
      CHECK(m.v_y == doctest::Approx(c.east * g_earth * 0.1 * dt));
    }
  }

  TEST_CASE("without the IMU it turns by what the rotors are sent beyond their mean, and is braked by them") {
    Blind b{.param = {.hub = 0}};
    b.in.turn = {.roll = 0.02, .pitch = -0.01};
    b.lose_imu();
    b.run(10);
    CHECK(std::abs(b.out.motion.p) < 1e-8);
    CHECK(std::abs(b.out.motion.q) < 1e-8);
    b.in.turn.roll += 0.01;
    b.in.turn.pitch += 0.02;
    b.run(200);
    CHECK(b.out.motion.p == doctest::Approx(153 * 0.01 / 3.9).epsilon(0.02).scale(0));
    CHECK(b.out.motion.q == doctest::Approx(153 * 0.02 / 3.9).epsilon(0.02).scale(0));
  }

  TEST_CASE("what turned it as it was told to is not taken for wind, nor what turns it since it moves") {
    Blind b;
    b.in.estimate.v_x = 2;
    b.run(400);
    b.in.turn.pitch = 0.05;
    for (int i = 0; i < 20; ++i) {
      b.run();
      b.in.estimate.q += (153 * b.state.felt.pitch - 3.9 * b.in.estimate.q) * dt;
    }
    CHECK(b.in.estimate.q > 1);
    // a tenth of what it was told to, 7.65 rad/s^2
    CHECK(std::abs(b.state.x.torque - b.param.hub * 2) < 0.7);
  }

  TEST_CASE("a demand is felt a period late, and to two thirds after 30 ms more") {
    Blind b;
    b.lose_imu();
    b.in.turn.roll = 0.1;
    b.run();
    CHECK(b.state.felt.roll == doctest::Approx(0));
    b.run(2);
    CHECK(b.state.felt.roll == doctest::Approx(0.1 * (1 - std::pow(0.03 / 0.045, 2))));
  }

  TEST_CASE("lasers show a lean that nobody knew of, away from their walls sooner than towards them") {
    const auto off_after = [](double lean, int periods) {
      Blind b;
      b.lose_imu();
      PushedBody body{.lean = lean};
      for (int i = 0; i < periods; ++i) {
        const double taken = -b.out.motion.pitch;
        body.run(b.param);
        b.in.estimate.fixes[0] = body.fix(taken);
        b.run();
      }
      return std::abs(-b.out.motion.pitch - lean);
    };
    CHECK(off_after(-0.03, 40) < 0.01);
    CHECK(off_after(0.03, 40) < 0.05);
    CHECK(off_after(-0.03, 40) < off_after(0.03, 40));
    CHECK(off_after(0.03, 120) < 0.015);
  }

  TEST_CASE("the less it knows its lean, the nearer to its wall than a ray says it takes itself to be") {
    for (const double range : {8.0, -12.0}) {
      Blind b;
      b.lose_imu();
      b.run();
      for (LeanGuess& guess : b.state.x.guesses) {
        guess.covariance = {};
        guess.covariance[0] = 1;
        guess.covariance[12] = 0.01;  // of the lean
      }
      b.in.estimate.fixes[0] = {.range = range, .is_new = true};
      // leaning by either side a ray is longer: the mean of range / cos(lean) - range
      CHECK(b.run().x == doctest::Approx(0.5 * range * 0.01).epsilon(0.03).scale(0));
    }
  }

  TEST_CASE("of its guesses, each of another wind, that one is believed most whose wind blows") {
    for (const auto& [gust, right] : {std::pair{-1.2, 1}, {0.0, 2}}) {
      Blind b;
      b.lose_imu();
      PushedBody body;
      double rate = 0;
      for (int i = 0; i < 40; ++i) {
        const double taken = -b.out.motion.pitch;
        rate += (b.param.hub * gust - b.param.damping * rate) * dt;
        body.lean += rate * dt;
        body.run(b.param);
        b.in.estimate.fixes[0] = body.fix(taken);
        b.run();
      }
      double sum = 0;
      for (const LeanGuess& guess : b.state.x.guesses) {
        CHECK(guess.weight <= b.state.x.guesses[static_cast<std::size_t>(right)].weight);
        sum += guess.weight;
      }
      CHECK(sum == doctest::Approx(1));
    }
  }

  TEST_CASE("wind turns and drags it less while its rotors turn slowly, by the root of their thrust") {
    Blind b{.param = {.hub = 0}};
    b.in.turn.pitch = 0.03;
    b.in.estimate.drag_x = 0.5;
    b.in.estimate.v_x = 1;
    b.lose_imu();
    b.in.lift.thrust = 0.49;
    b.run(400);
    // its mean demand is more than wind takes by now
    CHECK(b.out.motion.q == doctest::Approx(153 * 0.03 * (1 - 0.7) / (0.7 * 3.9)).epsilon(0.01).scale(0));
    CHECK(b.out.motion.drag_x == doctest::Approx(0.7 * (0.5 + 0.208)).epsilon(0.01).scale(0));
  }

  TEST_CASE("however long it has stood with its rotors at rest, it knows how it stands") {
    Blind b;
    b.in.lift.thrust = 0;
    b.in.estimate.roll = 0.02;
    CHECK(b.run(100'000).roll == doctest::Approx(0.02));
    CHECK(b.out.motion.known);
  }

  TEST_CASE("the ground lifts it, and its lower side more") {
    // Cheeseman and Bennett, of rotors of 0.25 m radius, 0.3 m from the middle, 0.25 m above its feet
    const auto gain = [](double height) { return 1 / (1 - std::pow(0.25 / (4 * height), 2)); };
    Blind b;
    b.in.estimate.pitch = -0.1;
    b.lose_imu();
    b.state.lift = g_earth;
    b.in.estimate.altitude = 0.05;
    CHECK(b.run().lift == doctest::Approx(g_earth * gain(0.3)));
    Blind level;
    level.in.estimate.pitch = -0.1;
    level.in.estimate.altitude = 0.05;
    level.run(400);
    const double turned = 0.5 * 153 * (gain(0.3 - 0.03) - gain(0.3 + 0.03));
    CHECK(level.out.motion.q == doctest::Approx(turned * dt).epsilon(0.04).scale(0));
  }

  TEST_CASE("it begins with the IMU's last reading, not with what fades between that and its loss") {
    Blind b;
    b.in.estimate.q = 0.5;
    b.run(400);
    for (int i = 1; i <= 3; ++i) {
      b.in.estimate.rates_age = i * dt;
      b.in.estimate.q = 0.5 * std::exp(-i * dt / 0.05);
      b.run();
    }
    b.in.estimate.rates_known = false;
    CHECK(b.run().q == doctest::Approx(0.5).epsilon(0.01).scale(0));  // as what has turned it so long still does
  }

  TEST_CASE("yaw is that of the model: by drag, and while rotors speed up") {
    Blind b;
    b.in.turn.yaw = 0.01;
    b.lose_imu();
    b.in.turn.yaw = 0.02;
    b.run();
    CHECK(b.out.motion.r == doctest::Approx(12.3 * 0.53 * 0.01).epsilon(1e-3).scale(0));
    b.run();
    CHECK(b.out.motion.r == doctest::Approx(12.3 * (0.53 + dt) * 0.01).epsilon(1e-3).scale(0));
    const double yaw = b.out.motion.yaw, r = b.out.motion.r;
    b.run();
    CHECK(b.out.motion.yaw == doctest::Approx(yaw + r * dt + 0.5 * 12.3 * 0.01 * dt * dt));
  }

  TEST_CASE("what carries it is what was felt, with what thrust adds and the climb takes") {
    Blind b;
    b.in.estimate.lift = 10;
    b.lose_imu();
    CHECK(b.run().lift == doctest::Approx(10));
    b.in.lift.thrust = 1.2;
    CHECK(b.run(40).lift == doctest::Approx(10 + 0.2 * g_earth).epsilon(1e-4).scale(0));
    b.in.estimate.climb = 0.5;
    // the rotors turn faster than before
    CHECK(b.run().lift == doctest::Approx(10 + 0.2 * g_earth - std::sqrt(1.2) * 0.83 * 0.5).epsilon(1e-4).scale(0));
  }

  TEST_CASE("it knows nothing 0.3 s after a laser has last seen along an axis") {
    for (const std::size_t seen : {0, 1}) {
      Blind b;
      b.in.estimate.drag_x = 0.5;
      b.lose_imu();
      b.in.estimate.fixes[seen] = {.range = 8, .is_new = true};
      CHECK(b.run(18).known);
      CHECK_FALSE(b.run(2).known);
    }
  }

  TEST_CASE("one that turns round faster than 0.1 rad/s does not know where its lasers look") {
    for (const double side : {-1.0, 1.0}) {
      Blind b;
      b.in.estimate.drag_x = 0.5;
      b.in.estimate.r = 0.09 * side;
      b.lose_imu();
      CHECK(b.run().known);
      Blind turning;
      turning.in.estimate.drag_x = 0.5;
      turning.in.estimate.r = 0.11 * side;
      turning.lose_imu();
      CHECK_FALSE(turning.run().known);
    }
  }

  TEST_CASE("a ray that is not square to its wall is believed less, for the yaw is not known") {
    const auto believed = [](double skew) {
      Blind b;
      b.lose_imu();
      b.in.estimate.fixes[0] = {.place = 0.01, .skew = skew, .range = 8, .is_new = true};
      return b.run().x;
    };
    CHECK(believed(0) > 0.003);
    CHECK(believed(2) < 0.1 * believed(0));
  }
}

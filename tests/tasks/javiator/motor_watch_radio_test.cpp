// What finds a weak motor, where signals and answers take their time or are lost.
#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "tests/tasks/javiator/watched.h"

namespace {
using namespace jarol;
using namespace jarol::tasks;
using tests::dt;
using tests::tick;
using tests::Watched;
}  // namespace

TEST_SUITE("tasks/javiator_motor_watch_radio") {
  TEST_CASE("signals that are not heard, and answers that are not, are no motor's fault") {
    std::mt19937 engine(5);
    for (int flight = 0; flight < 20; ++flight) {
      Watched w;
      for (int i = 0; i < 200; ++i) {
        // as after a gust, with a quarter of the signals lost
        const double turn = 4000 * std::sin(0.5 * i) * std::exp(-0.05 * (i % 40));
        w.period({8000 + turn, 8000, 8000 - turn, 8000}, engine() % 4 != 0);
      }
      CHECK(w.out.motors.weak == Motor::none);
    }
  }

  TEST_CASE("however long signals and answers are on their way, it knows what had acted") {
    for (const std::size_t delay : {1, 2, 3}) {
      std::mt19937 engine(3);
      Watched w;
      w.delay = delay;
      w.run(100);
      w.body.parts[0] = 0.5;
      CHECK(w.seconds_until_weak() < 0.1 + 2 * static_cast<double>(delay) * dt);
      Watched sound;
      sound.delay = delay;
      for (int i = 0; i < 2000; ++i) {
        std::array<double, 4> sent{};
        for (double& signal : sent) signal = 4000 + 8000.0 * static_cast<double>(engine()) / 4294967296.0;
        sound.period(sent);
        if (i > 100)
          for (const double evidence : sound.state.evidence) REQUIRE(evidence == 0);
      }
    }
  }

  TEST_CASE(
      "where a tenth is lost on either way, a weak motor is found within three tenths of a second, in one on average") {
    std::mt19937 engine(5);
    double all = 0;
    const auto heard = [&] { return engine() % 10 != 0; };
    for (int flight = 0; flight < 200; ++flight) {
      Watched w;
      w.delay = 1;
      const auto fly = [&](int periods) {
        int i = 0;
        for (; i < periods && w.out.motors.weak == Motor::none; ++i) {
          const double turn = 2000 * std::sin(0.3 * i);
          const bool signals_heard = heard(), answer_heard = heard();
          w.period({8000 + turn, 8000, 8000 - turn, 8000}, signals_heard, answer_heard);
        }
        return i * dt;
      };
      fly(100);
      REQUIRE(w.out.motors.weak == Motor::none);
      w.body.parts[1] = 0.5;
      const double time = fly(100);
      CHECK(time < 0.3);
      CHECK(w.out.motors.weak == Motor::right);
      all += time;
    }
    const double mean = all / 200;
    CHECK(mean < 0.1);
  }

  TEST_CASE("what one sample has begun, another may end of which is not sure what had acted") {
    Watched w;
    w.body.parts[0] = 0.5;
    while (w.state.evidence[0] == 0) w.run(1);
    CHECK(w.out.motors.weak == Motor::none);
    w.reports.clear();  // an answer is lost
    w.run(2);
    CHECK(w.out.motors.weak == Motor::front);
  }

  TEST_CASE("after half a second of silence it begins anew") {
    Watched w;
    w.body.parts[0] = 0.5;
    while (w.state.evidence[0] == 0) w.run(1);
    CHECK(w.out.motors.weak == Motor::none);
    w.body.parts[0] = 1;
    w.reports.clear();
    for (int i = 0; i < 40; ++i) w.period({8000, 8000, 8000, 8000}, true, false);
    CHECK(w.state.evidence == std::array<double, 4>{});
    w.run(40);
    CHECK(w.out.motors.weak == Motor::none);
    w.body.parts[2] = 0.5;
    CHECK(w.seconds_until_weak() < 0.1);
    CHECK(w.out.motors.weak == Motor::rear);
  }

  TEST_CASE("numbers of commands that it never saw are no motor's fault, and take no time") {
    Watched w;
    w.in.sensors = {.new_imu = true, .answers = 1000, .answered = 4'000'000'000};
    for (int i = 0; i < 3; ++i) {
      ++w.in.sensors.answers;
      ++w.in.sensors.answered;
      MotorWatch::run(w.param, tick, w.in, w.state, w.out);
    }
    CHECK(w.state.acted <= w.number);
    CHECK(w.out.motors.weak == Motor::none);
  }

  TEST_CASE("where the mixer fails and its command is held, that acts for longer") {
    std::mt19937 engine(3);
    Watched w;
    for (int i = 0; i < 2000; ++i) {
      w.held = i % 7 == 0;
      std::array<double, 4> sent{};
      for (double& signal : sent) signal = 4000 + 8000.0 * static_cast<double>(engine()) / 4294967296.0;
      w.period(sent);
      for (const double evidence : w.state.evidence) REQUIRE(evidence == 0);
      REQUIRE(w.state.doubt == 0);
    }
  }

  TEST_CASE("one sample that nothing explains is no motor's fault") {
    Watched w;
    w.sampled.p += 1;
    w.answer.p += 1;
    w.run(1);
    for (auto& report : w.reports)
      if (report) report->p += 1;
    w.run(10);
    CHECK(w.out.motors.weak == Motor::none);
  }
}

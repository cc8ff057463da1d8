// A submarine's operator at a console, in conversation with the adapter.
#pragma once

#include <doctest/doctest.h>

#include <vector>

#include "distributers/interfaces/typed.h"
#include "distributers/lauv/operator.h"
#include "distributers/messages/imc.h"

namespace jarol::tests {

using namespace std::chrono_literals;
namespace imc = messages::imc;
using distributers::LauvOperator;
using distributers::LauvOperatorParameters;
using OpMode = imc::VehicleState::OpMode;

// What the console gets.
struct Console : messages::Receiver {
  void receive(messages::MessageRef message) override { got.emplace_back(message); }

  template <class M>
  std::vector<M> all() const {
    std::vector<M> found;
    for (const messages::Message& message : got)
      if (const M* m = message.as<M>()) found.push_back(*m);
    return found;
  }
  template <class M>
  M last() const {
    const auto found = all<M>();
    REQUIRE_FALSE(found.empty());
    return found.back();
  }
  std::vector<messages::Message> got;
};

// A run of 50 ms steps that nothing but the console takes part in.
struct Conversation {
  explicit Conversation(const LauvOperatorParameters& parameters = {}) : adapter(parameters) { adapter.reach(0ms, to); }

  template <class M>
  void say(const M& message) {
    adapter.receive(messages::refer_to(message));
  }
  void act(const char* actions) { say(imc::RemoteActions{actions}); }
  void pass(Duration time) {
    for (const Duration end = now + time; now < end;) adapter.reach(now += 50ms, to);
  }
  void report(const tasks::VehicleReport& reported) { adapter.hand_over<&LauvOperator::Out::report>(reported, to); }
  tasks::Setpoint setpoint() {
    adapter.take<&LauvOperator::In::setpoint>(value);
    return value;
  }
  tasks::Contact contact() {
    tasks::Contact contact;
    REQUIRE(adapter.take<&LauvOperator::In::contact>(contact));
    return contact;
  }
  double silence() { return contact().silence; }
  std::uint8_t op_mode() const { return to.last<imc::VehicleState>().op_mode; }

  distributers::Typed<LauvOperator> adapter;
  Console to;
  Duration now{};
  tasks::Setpoint value;
};

inline void check(const tasks::Setpoint& is, const tasks::Setpoint& wanted) {
  CHECK(is.depth == wanted.depth);
  CHECK(is.heading == doctest::Approx(wanted.heading));
  CHECK(is.speed == wanted.speed);
  CHECK(is.turn == wanted.turn);
  CHECK(is.rate == doctest::Approx(wanted.rate));
  CHECK(is.drive == wanted.drive);
  CHECK(is.thrust == doctest::Approx(wanted.thrust));
}

inline tasks::Setpoint by_hand(double rate, double thrust) {
  return {0, 0, 0, tasks::Turn::rate, rate, tasks::Drive::thrust, thrust};
}

}  // namespace jarol::tests

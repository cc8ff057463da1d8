// The shipped graph of the submarine in conversation with a console.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "tasks/values/alarm.h"
#include "tasks/values/guidance.h"
#include "tasks/values/lauv.h"
#include "tests/distributers/lauv_console.h"
#include "tools/library/session.h"

namespace jarol::test {

using namespace std::chrono_literals;

// The vehicle and its tasks, with a console in place of the script; both meet each 100 ms, as by a link.
class Mission {
 public:
  explicit Mission(std::vector<std::string> set = {}, const std::string& profile = "")
      : session_(open(std::move(set), profile)) {}

  template <class M>
  void say(const M& message) {
    console.say(message);
  }
  // Until that is so, and at most for that time. False: it never was.
  bool fly(
      Duration longest, const std::function<bool()>& until = [] { return false; }) {
    for (const Duration end = session_.now() + longest; session_.now() < end;) {
      step();
      if (until()) return true;
    }
    return false;
  }
  double truth(const char* field) const { return session_.true_value(std::string(field) + " of dune"); }
  tasks::Progress progress() const { return session_.value<tasks::Progress>("guidance.progress"); }
  messages::imc::PlanControlState plan() const { return console.to.last<messages::imc::PlanControlState>(); }
  bool is_over() const { return plan().state != messages::imc::PlanControlState::State::EXECUTING; }
  tasks::Alarm alarm() const { return session_.value<tasks::Condition>("supervisor.condition").alarm; }
  Duration now() const { return session_.now(); }

  tests::Conversation console;

 private:
  static Session open(std::vector<std::string> set, const std::string& profile) {
    set.emplace_back("distributers.dune.link.parameters.dynamics=rigid");
    set.emplace_back("expect=nothing");
    return jarol::open("specs/exolauv.yaml", {.profile = profile, .set = std::move(set), .seed = 3, .fed = {"neptus"}});
  }
  void step() {
    auto& adapter = console.adapter;
    console.pass(100ms);
    feed<&distributers::LauvOperator::In::setpoint>("neptus.setpoint", setpoint_);
    feed<&distributers::LauvOperator::In::leg>("neptus.leg", leg_);
    session_.feed("neptus.contact", console.contact());
    session_.run_for(100ms);
    adapter.hand_over<&distributers::LauvOperator::Out::report>(session_.value<tasks::VehicleReport>("report.report"),
                                                                console.to);
    adapter.hand_over<&distributers::LauvOperator::Out::motion>(session_.value<tasks::Motion>("navigation.motion"),
                                                                console.to);
    adapter.hand_over<&distributers::LauvOperator::Out::progress>(progress(), console.to);
  }
  template <auto Channel, class T>
  void feed(const char* name, T& value) {
    if (console.adapter.take<Channel>(value)) session_.feed(name, value);
  }

  Session session_;
  tasks::Setpoint setpoint_;
  tasks::Leg leg_;
};

}  // namespace jarol::test

#include "distributers/links/console.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "distributers/interfaces/typed.h"
#include "distributers/javiator/operator.h"
#include "distributers/lauv/operator.h"
#include "distributers/links/link_type.h"
#include "graph/values/value.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
using namespace std::chrono_literals;

// The external system of the helicopter's operator, as a graph has them.
struct Channelled {
  DistributerClass operator_class = distributer_class<JaviatorOperator>();
  ConsoleSystem system{operator_class.make(Value(*operator_class.parameters).data())};
  std::string why;
  tasks::PilotCommand command;

  bool send(messages::MessageRef message) { return system.port()->send(message, why); }
  const tasks::PilotCommand& reach(Duration instant) {
    system.reach(instant);
    CHECK(system.take(0, &command));
    return command;
  }
};

// The submarine's operator, and what the console gets of its distributer.
struct Submarine : messages::Receiver {
  void receive(messages::MessageRef message) override { got.emplace_back(message); }
  void reach(Duration instant) {
    system.reach(instant);
    system.port()->receive_answers(*this);
  }
  template <class M>
  std::size_t count() const {
    return static_cast<std::size_t>(
        std::count_if(got.begin(), got.end(), [](const messages::Message& m) { return m.as<M>() != nullptr; }));
  }

  DistributerClass operator_class = distributer_class<LauvOperator>();
  ConsoleSystem system{operator_class.make(Value(*operator_class.parameters).data())};
  std::vector<messages::Message> got;
};
}  // namespace

TEST_SUITE("distributers/links/console") {
  TEST_CASE("what the operator sends at a page reaches the graph at the next instant, to the number") {
    Channelled at;
    CHECK_FALSE(at.reach(0ms).heard);
    CHECK(at.send(messages::refer_to(javiator::CommandData{.roll = 75, .pitch = -10, .yaw = 1571, .z = 1000})));
    CHECK(at.reach(15ms).heard);
    CHECK(at.command.roll == 0.075);
    CHECK(at.command.pitch == -0.01);
    CHECK(at.command.yaw == 1.571);
    CHECK(at.command.altitude == 1);
    CHECK_FALSE(at.reach(30ms).heard);
  }

  TEST_CASE("a switch is meant from the first on, as nobody else has been there before") {
    Channelled at;
    CHECK(at.send(messages::refer_to(javiator::SwitchState{})));
    CHECK(at.reach(0ms).state_switches == 1);
  }

  TEST_CASE("what finds no room is refused and counted") {
    Channelled at;
    for (std::size_t i = 0; i < ConsolePort::max_packets; ++i) CHECK(at.send(messages::refer_to(javiator::ShutDown{})));
    CHECK_FALSE(at.send(messages::refer_to(javiator::ShutDown{})));
    CHECK(at.why == "the run has not taken what was sent before");
    CHECK(at.reach(0ms).shut_downs == ConsolePort::max_packets);
    const LinkReport report = *at.system.link_report();
    CHECK(report.link == "console");
    CHECK(
        report.counts ==
        std::vector<std::pair<std::string, std::uint64_t>>{
            {"messages in", 64}, {"refused", 1}, {"left out: the page was gone", 0}, {"messages out", 0}, {"lost", 0}});
  }

  TEST_CASE("what still waits when its sender has gone is left out and counted, but for emergencies") {
    Channelled at;
    CHECK(at.send(messages::refer_to(javiator::CommandData{.roll = 75})));
    CHECK(at.send(messages::refer_to(javiator::ShutDown{})));
    CHECK(at.send(messages::refer_to(javiator::CommandData{.roll = 80})));
    at.system.port()->leave_out_waiting();
    CHECK(at.reach(0ms).roll == 0);
    CHECK(at.command.shut_downs == 1);
    CHECK(at.send(messages::refer_to(javiator::CommandData{.roll = -30})));
    CHECK(at.reach(15ms).roll == -0.03);
    const LinkReport report = *at.system.link_report();
    CHECK(
        report.counts ==
        std::vector<std::pair<std::string, std::uint64_t>>{
            {"messages in", 4}, {"refused", 0}, {"left out: the page was gone", 2}, {"messages out", 0}, {"lost", 0}});
    CHECK(report.dropped == 2);
  }

  TEST_CASE("what the distributer answers reaches the console, to the word") {
    Submarine at;
    imc::PlanControl question;
    question.op = imc::PlanControl::Op::GET;
    question.request_id = 7;
    std::string why;
    REQUIRE(at.system.port()->send(messages::refer_to(question), why));
    at.reach(0ms);
    REQUIRE(at.count<imc::PlanControl>() == 1);
    const auto* answer = std::find_if(at.got.begin(), at.got.end(), [](const messages::Message& m) {
                           return m.as<imc::PlanControl>() != nullptr;
                         })->as<imc::PlanControl>();
    CHECK(answer->type == imc::PlanControl::Type::FAILURE);
    CHECK(answer->request_id == 7);
    CHECK(answer->info == "no plan is loaded");
  }

  TEST_CASE("what it says unasked comes as well, but not what the graph publishes anyway") {
    Submarine at;
    at.reach(0ms);
    CHECK(at.count<imc::VehicleState>() == 1);
    CHECK(at.count<imc::PlanControlState>() == 1);
    const auto motion = std::find_if(at.operator_class.channels.begin(), at.operator_class.channels.end(),
                                     [](const ChannelClass& channel) { return channel.name == "motion"; });
    const auto which = static_cast<std::size_t>(motion - at.operator_class.channels.begin());
    at.system.hand_over(which, Value(type_of<tasks::Motion>()).data());
    at.reach(50ms);
    CHECK(at.count<imc::EstimatedState>() == 0);
  }

  TEST_CASE("answers that nobody takes are bounded, and those that are lost are counted") {
    Submarine at;
    // three messages a second
    for (int second = 0; second < 30; ++second) at.system.reach(second * 1s);
    at.system.port()->receive_answers(at);
    CHECK(at.got.size() == ConsolePort::max_packets);
    CHECK(at.system.port()->answered() == ConsolePort::max_packets);
    CHECK(at.system.port()->lost() == 90 - ConsolePort::max_packets);
    at.got.clear();
    at.reach(30s);
    CHECK(at.got.size() == 3);
  }

  TEST_CASE("the console may outlive the run") {
    std::shared_ptr<ConsolePort> port;
    {
      const Channelled at;
      port = at.system.port();
    }
    std::string why;
    CHECK(port->send(messages::refer_to(javiator::ShutDown{}), why));
  }

  TEST_CASE("it is no link of vehicles") {
    const LinkType link = console_link();
    CHECK(link.for_operators);
    CHECK_FALSE(link.for_vehicles);
  }
}

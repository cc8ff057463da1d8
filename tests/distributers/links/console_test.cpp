#include "distributers/links/console.h"

#include <doctest/doctest.h>

#include "distributers/interfaces/typed.h"
#include "distributers/javiator/operator.h"
#include "distributers/links/link_type.h"
#include "graph/values/value.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
using namespace std::chrono_literals;

// Channels of the helicopter's operator, as a graph has them.
struct Channelled {
  DistributerClass operator_class = distributer_class<JaviatorOperator>();
  ConsoleChannels channels{operator_class.make(Value(*operator_class.parameters).data())};
  std::string why;
  tasks::PilotCommand command;

  bool send(messages::MessageRef message) { return channels.port()->send(message, why); }
  const tasks::PilotCommand& reach(Duration instant) {
    channels.reach(instant);
    CHECK(channels.take(0, &command));
    return command;
  }
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
    for (std::size_t i = 0; i < ConsolePort::most_packets; ++i)
      CHECK(at.send(messages::refer_to(javiator::ShutDown{})));
    CHECK_FALSE(at.send(messages::refer_to(javiator::ShutDown{})));
    CHECK(at.why == "the run has not taken what was sent before");
    CHECK(at.reach(0ms).shut_downs == ConsolePort::most_packets);
    const LinkReport report = *at.channels.link_report();
    CHECK(report.link == "console");
    CHECK(report.counts == std::vector<std::pair<std::string, std::uint64_t>>{{"messages in", 64}, {"refused", 1}});
  }

  TEST_CASE("the console may outlive the run") {
    std::shared_ptr<ConsolePort> port;
    {
      const Channelled at;
      port = at.channels.port();
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

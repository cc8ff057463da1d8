// The rover's messages on one side, values on the other.
#pragma once

#include <jarol/distributer.h>

#include "distributer/values.h"
#include "messages/rover.h"

class RoverRadio {
 public:
  static constexpr std::string_view summary = "a rover, by its radio";
  static constexpr bool is_vehicle = true;
  struct In {
    jarol::distributers::Newest<Pose> pose;
    static constexpr auto fields() {
      return jarol::describe(jarol::distributers::channel<&In::pose>("where it is, by its own reckoning"));
    }
  };
  struct Out {
    Drive drive;
    static constexpr auto fields() {
      return jarol::describe(jarol::distributers::channel<&Out::drive>("what its motors are to do"));
    }
  };
  static const jarol::messages::MessageSet& message_set() { return jarol::messages::rover::message_set(); }
  static constexpr auto handlers() {
    using namespace jarol::distributers;
    return handle(on<jarol::messages::rover::Pose>(&RoverRadio::hear), send<&Out::drive>(&RoverRadio::drive));
  }
  In in;

  void hear(const jarol::messages::rover::Pose& message) {
    in.pose = Pose{.x = message.x, .y = message.y, .heading = message.heading};
  }
  void drive(const Drive& drive, jarol::messages::Receiver& rover) {
    const jarol::messages::rover::Drive message{.speed = static_cast<float>(drive.speed),
                                                .turn = static_cast<float>(drive.turn)};
    rover.receive(jarol::messages::refer_to(message));
  }
};

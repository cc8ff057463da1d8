#include "tasks/add_tasks.h"
#include "tasks/javiator/altitude_control.h"
#include "tasks/javiator/blind_observer.h"
#include "tasks/javiator/control.h"
#include "tasks/javiator/filter.h"
#include "tasks/javiator/flight_logic.h"
#include "tasks/javiator/motor_watch.h"

namespace jarol::tasks {

void add_javiator_tasks(Registry& registry) {
  add<AltitudeControl, AttitudeControl, BlindObserver, FlightLogic, HelicopterReporter, JaviatorFilter, MotorMixer,
      MotorWatch, PositionControl>(registry);
}

}  // namespace jarol::tasks

#include "tasks/add_tasks.h"

namespace jarol::tasks {

struct AltitudeControl;
struct AttitudeControl;
struct BlindObserver;
struct FlightLogic;
struct HelicopterReporter;
struct JaviatorFilter;
struct MotorMixer;
struct MotorWatch;
struct PositionControl;

void add_javiator_tasks(Registry& registry) {
  add<AltitudeControl, AttitudeControl, BlindObserver, FlightLogic, HelicopterReporter, JaviatorFilter, MotorMixer,
      MotorWatch, PositionControl>(registry);
}

}  // namespace jarol::tasks

#include "tasks/tasks.h"

#include "tasks/flight_logic.h"
#include "tasks/generic.h"
#include "tasks/javiator_control.h"
#include "tasks/javiator_filter.h"
#include "tasks/lauv_control.h"
#include "tasks/lauv_navigation.h"
#include "tasks/lauv_supervisor.h"
#include "tasks/original_control.h"
#include "tasks/original_filter.h"

namespace jarol::tasks {
namespace {

template <class... T>
void add(Registry& registry) {
  (registry.add(task_class<T>()), ...);
}

}  // namespace

void add_tasks(Registry& registry) {
  add<Accumulate, Counter, Mean, Relay, Sum, Window, Work>(registry);
  add<AltitudeControl, AttitudeControl, FlightLogic, HelicopterReporter, JaviatorFilter, MotorMixer, PositionControl>(
      registry);
  add<OriginalAltitude, OriginalAttitude, OriginalFilter, OriginalLogic, OriginalMixer, OriginalPosition>(registry);
  add<DepthControl, FinAllocator, HeadingControl, LauvForward, LauvNavigation, LauvReport, LauvSupervisor,
      SpeedControl>(registry);
}

}  // namespace jarol::tasks

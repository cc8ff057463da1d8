#include "tasks/tasks.h"

#include "tasks/generic.h"
#include "tasks/javiator/altitude_control.h"
#include "tasks/javiator/blind_observer.h"
#include "tasks/javiator/control.h"
#include "tasks/javiator/filter.h"
#include "tasks/javiator/flight_logic.h"
#include "tasks/javiator/motor_watch.h"
#include "tasks/javiator/original_control.h"
#include "tasks/javiator/original_filter.h"
#include "tasks/lauv/control.h"
#include "tasks/lauv/fins.h"
#include "tasks/lauv/guidance.h"
#include "tasks/lauv/navigation.h"
#include "tasks/lauv/supervisor.h"

namespace jarol::tasks {
namespace {

// trusted: tests/tools/machine_code_test.cpp looks at their code
template <class... T>
void add(Registry& registry) {
  (registry.add(trusted_task_class<T>()), ...);
}

}  // namespace

void add_tasks(Registry& registry) {
  add<Accumulate, Counter, Mean, Relay, Sum, Window, Work>(registry);
  add<AltitudeControl, AttitudeControl, BlindObserver, FlightLogic, HelicopterReporter, JaviatorFilter, MotorMixer,
      MotorWatch, PositionControl>(registry);
  add<OriginalAltitude, OriginalAttitude, OriginalFilter, OriginalLogic, OriginalMixer, OriginalPosition>(registry);
  add<DepthControl, FaultTolerantAllocator, FinAllocator, FinWatch, HeadingControl, LauvForward, LauvGuidance,
      LauvNavigation, LauvReport, LauvSupervisor, SpeedControl>(registry);
}

}  // namespace jarol::tasks

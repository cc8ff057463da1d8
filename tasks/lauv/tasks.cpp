#include "tasks/add_tasks.h"
#include "tasks/lauv/control.h"
#include "tasks/lauv/fins.h"
#include "tasks/lauv/guidance.h"
#include "tasks/lauv/navigation.h"
#include "tasks/lauv/supervisor.h"

namespace jarol::tasks {

void add_lauv_tasks(Registry& registry) {
  add<DepthControl, FaultTolerantAllocator, FinAllocator, FinWatch, HeadingControl, LauvForward, LauvGuidance,
      LauvNavigation, LauvReport, LauvSupervisor, SpeedControl>(registry);
}

}  // namespace jarol::tasks

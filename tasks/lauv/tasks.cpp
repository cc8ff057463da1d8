#include "tasks/add_tasks.h"

namespace jarol::tasks {

struct DepthControl;
struct FaultTolerantAllocator;
struct FinAllocator;
struct FinWatch;
struct HeadingControl;
struct LauvForward;
struct LauvGuidance;
struct LauvNavigation;
struct LauvReport;
struct LauvSupervisor;
struct SpeedControl;

void add_lauv_tasks(Registry& registry) {
  add<DepthControl, FaultTolerantAllocator, FinAllocator, FinWatch, HeadingControl, LauvForward, LauvGuidance,
      LauvNavigation, LauvReport, LauvSupervisor, SpeedControl>(registry);
}

}  // namespace jarol::tasks

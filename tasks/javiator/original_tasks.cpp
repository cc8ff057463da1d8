#include "tasks/add_tasks.h"
#include "tasks/javiator/original_control.h"
#include "tasks/javiator/original_filter.h"

namespace jarol::tasks {

void add_original_tasks(Registry& registry) {
  add<OriginalAltitude, OriginalAttitude, OriginalFilter, OriginalLogic, OriginalMixer, OriginalPosition>(registry);
}

}  // namespace jarol::tasks

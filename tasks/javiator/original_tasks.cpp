#include "tasks/add_tasks.h"

namespace jarol::tasks {

struct OriginalAltitude;
struct OriginalAttitude;
struct OriginalFilter;
struct OriginalLogic;
struct OriginalMixer;
struct OriginalPosition;

void add_original_tasks(Registry& registry) {
  add<OriginalAltitude, OriginalAttitude, OriginalFilter, OriginalLogic, OriginalMixer, OriginalPosition>(registry);
}

}  // namespace jarol::tasks

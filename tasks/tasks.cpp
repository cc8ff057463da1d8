#include "tasks/tasks.h"

#include "tasks/add_tasks.h"
#include "tasks/generic.h"

namespace jarol::tasks {

void add_tasks(Registry& registry) {
  add<Accumulate, Counter, Mean, Relay, Sum, Window, Work>(registry);
  add_javiator_tasks(registry);
  add_original_tasks(registry);
  add_lauv_tasks(registry);
}

}  // namespace jarol::tasks

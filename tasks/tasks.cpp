#include "tasks/tasks.h"

#include <utility>

#include "tasks/add_tasks.h"

namespace jarol::tasks {

struct Accumulate;
struct Counter;
struct Mean;
struct Relay;
struct Sum;
struct Window;
struct Work;

void add_class(Registry& registry, TaskClass task) { registry.add(std::move(task)); }

void add_tasks(Registry& registry) {
  add<Accumulate, Counter, Mean, Relay, Sum, Window, Work>(registry);
  add_javiator_tasks(registry);
  add_original_tasks(registry);
  add_lauv_tasks(registry);
}

}  // namespace jarol::tasks

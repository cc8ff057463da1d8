// The catalogue room by room. Its lists name tasks only, as each task's own file adds it (tasks/add_task.h): a changed
// task has that file compiled again, and nothing else of this folder.
#pragma once

namespace jarol {
class Registry;
struct TaskClass;
}  // namespace jarol

namespace jarol::tasks {

void add_class(Registry& registry, TaskClass task);

template <class T>
void add_task(Registry& registry);

template <class... T>
void add(Registry& registry) {
  (add_task<T>(registry), ...);
}

void add_javiator_tasks(Registry& registry);
void add_original_tasks(Registry& registry);
void add_lauv_tasks(Registry& registry);

}  // namespace jarol::tasks

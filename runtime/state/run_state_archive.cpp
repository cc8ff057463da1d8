// The state of a run in an archive: values, what only faults need to know, and how far it has come.
#include "graph/values/archive.h"
#include "graph/values/heap_archive.h"
#include "runtime/state/run_state.h"

namespace jarol {
namespace {

void serialize_text(Archive& archive, FaultText& text) {
  std::string words = text.text;
  archive(words);
  if (archive.restores()) keep_text(text, words);
}

// The first of `first`, `first + period`, ... that is not before the instant, counted from 0.
std::int64_t count_before(Duration instant, Duration first, Duration period) {
  return first >= instant ? 0 : (instant - first - Duration(1)) / period + 1;
}

}  // namespace

void RunState::serialize(Archive& archive, Duration covered) {
  archive.same(plan.outputs.size(), "is of other tasks");
  for (std::size_t i = 0; i < plan.graph.tasks.size(); ++i) {
    try {
      serialize_task(archive, i);
    } catch (const NotSaveable& error) {
      throw NotSaveable("task '" + plan.graph.tasks[i].name + "': " + error.what());
    }
  }
  for (DeepInput& input : deep_inputs_) {
    serialize_text(archive, input);
    archive(input.lost);
  }
  for (std::size_t i = 0; i < plan.graph.communicators.size(); ++i) serialize_communicator(archive, i);
  archive.bytes(tap_memory_.data(), tap_memory_.size() * sizeof tap_memory_[0]);
  archive.bytes(tap_news.data(), tap_news.size());
  if (archive.restores()) go_to(covered);
}

void RunState::serialize_task(Archive& archive, std::size_t i) {
  const TaskClass& c = *plan.graph.tasks[i].task_class;
  const Layout::OfTask& place = plan.layout.tasks[i];
  TaskStatus& of_task = status[i];
  if (of_task.heap == nullptr) {
    archive.value(*c.in, at(place.in));
    archive.value(*c.state, at(place.state));
    archive.value(*c.out, at(place.out));
  } else {
    HeapArchive values(archive, *of_task.heap);
    values.value(*c.in, at(place.in));
    values.value(*c.state, at(place.state));
    values.value(*c.out, at(place.out));
    values.finish();
  }
  // of an activation whose LET is under way
  bad_outcomes -= outcomes[i] != Outcome::good ? 1 : 0;
  archive(outcomes[i], of_task.skip_next, of_task.begins_anew, recent_faults[i]);
  archive.require(!of_task.begins_anew || of_task.state_type != nullptr, "begins a task anew that is never restarted");
  const std::size_t most_recent =
      plan.graph.tasks[i].fault_limit ? static_cast<std::size_t>(plan.graph.tasks[i].fault_limit->faults) : 0;
  archive.require(recent_faults[i].size() <= most_recent, "has more recent faults than the task's limit");
  archive.require(outcomes[i] <= Outcome::out_of_range, "has an outcome that there is not");
  bad_outcomes += outcomes[i] != Outcome::good ? 1 : 0;
  if (outcomes[i] == Outcome::good) return;
  archive(of_task.activation);
  serialize_text(archive, of_task);
}

void RunState::serialize_communicator(Archive& archive, std::size_t i) {
  const Type& type = *plan.graph.communicators[i].type;
  archive.value(type, at(plan.layout.communicators[i].value));
  archive.value(type, at(plan.layout.communicators[i].input));
}

// Each group acts next at its first instant that was not run.
void RunState::go_to(Duration covered) {
  release_queue.clear();
  release_queue.reserve(plan.groups.size());
  for (std::size_t i = 0; i < plan.groups.size(); ++i) {
    const Duration first = plan.groups[i].first, period = plan.groups[i].period;
    releases[i] = count_before(covered, first, period);
    release_queue.add(first + releases[i] * period, period);
  }
}

}  // namespace jarol

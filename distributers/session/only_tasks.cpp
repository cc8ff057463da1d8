#include "distributers/session/only_tasks.h"

#include <algorithm>
#include <span>

#include "graph/language/problems.h"
#include "graph/text/errors.h"
#include "runtime/record/cdr.h"
#include "runtime/record/ros2msg.h"

namespace jarol {
namespace {

constexpr std::size_t none = static_cast<std::size_t>(-1);

// Gives each channel what was published under its name at the instant.
class PublishedSystem : public ExternalSystem {
 public:
  PublishedSystem(const Recording& recording, const std::vector<ChannelClass>& channels) {
    for (const ChannelClass& channel : channels) {
      const ReadTopic& topic = *recording.find(channel.name);
      sources_.push_back({MessageCursor(recording, topic), channel.type});
    }
  }

  void reach(Duration instant) override { now_ = instant; }
  bool take(std::size_t channel, void* value) override {
    Source& source = sources_[channel];
    const mcap::Message* message = source.cursor.message();
    while (message != nullptr && message->time < now_) {
      source.cursor.next();
      message = source.cursor.message();
    }
    if (message == nullptr || message->time != now_) return false;
    const std::span bytes(reinterpret_cast<const std::byte*>(message->data.data()), message->data.size());
    if (const std::string wrong = decode_cdr(*source.type, bytes, value); !wrong.empty())
      throw LogError("the recording has a value that " + wrong + "; it is none that jarol run has written");
    source.cursor.next();
    return true;
  }
  void hand_over(std::size_t, const void*) override {}

 private:
  struct Source {
    MessageCursor cursor;
    const Type* type = nullptr;
  };
  std::vector<Source> sources_;
  Duration now_{};
};

}  // namespace

OnlyTasks::OnlyTasks(const Graph& graph, const std::vector<std::string>& tasks, const Recording& recording)
    : recording_(recording) {
  made_.graph = std::make_unique<Graph>();
  made_.graph->name = graph.name;
  made_.graph->platform = graph.platform;
  made_.graph->fault_limit = graph.fault_limit;
  keep_tasks(graph, tasks);
  connect(graph);
  if (recorded_.channels.empty()) return;
  recorded_.name = "recorded";
  made_.graph->distributers.push_back(
      {.name = "recorded", .where = {}, .distributer_class = &recorded_, .link = {}, .parameters = {}});
  made_.systems.push_back(std::make_unique<PublishedSystem>(recording, recorded_.channels));
}

// Else the replay would say that it is the same, and nobody has compared it.
void OnlyTasks::require_recorded(const std::string& output, const Type& type) const {
  const ReadTopic* const topic = recording_.find(output);
  const std::string which = "of '" + output + "', which these tasks publish, and they can't be compared; ";
  if (topic == nullptr)
    throw InputError("--only: the recording has no values " + which +
                     "record all that is published, jarol run --record, or leave the task out");
  if (topic->schema != schema_of(type).text)
    throw InputError("--only: the recording has values of another type " + which +
                     "replay the graph of the run, or leave the task out");
}

void OnlyTasks::keep_tasks(const Graph& graph, const std::vector<std::string>& names) {
  std::vector<std::string> known;
  for (const Task& task : graph.tasks) known.push_back(task.name);
  for (const std::string& name : names)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw InputError("--only: the graph has no task '" + name + "'" + did_you_mean(name, known) +
                       "; it has: " + list_of(known));
  kept_.assign(graph.tasks.size(), none);
  for (std::size_t i = 0; i < graph.tasks.size(); ++i) {
    if (std::find(names.begin(), names.end(), known[i]) == names.end()) continue;
    kept_[i] = made_.graph->tasks.size();
    made_.graph->tasks.push_back(graph.tasks[i]);
    const std::vector<TypeField>& fields = graph.tasks[i].task_class->out->fields;
    for (std::size_t f = 0; f < fields.size(); ++f) {
      outputs_.push_back(end_name(graph, {End::Kind::task, i, f}, true));
      require_recorded(outputs_.back(), *fields[f].type);
    }
  }
  for (const std::size_t i : graph.order)
    if (kept_[i] != none) made_.graph->order.push_back(kept_[i]);
}

void OnlyTasks::connect(const Graph& graph) {
  const auto is_kept = [&](const End& end) { return end.kind == End::Kind::task && kept_[end.index] != none; };
  for (const Connection& c : graph.connections)
    if (is_kept(c.to) && !is_kept(c.from)) add_source(graph, c.from, *c.type);
  // communicators are in order of name
  std::vector<Communicator>& communicators = made_.graph->communicators;
  std::sort(communicators.begin(), communicators.end(),
            [](const Communicator& a, const Communicator& b) { return a.name < b.name; });
  for (Connection c : graph.connections) {
    if (!is_kept(c.to)) continue;
    const std::string source = end_name(graph, c.from, true);
    c.to.index = kept_[c.to.index];
    if (is_kept(c.from)) {
      c.from.index = kept_[c.from.index];
    } else {
      const auto at = std::find_if(communicators.begin(), communicators.end(),
                                   [&](const Communicator& communicator) { return communicator.name == source; });
      c.from = {End::Kind::communicator, static_cast<std::size_t>(at - communicators.begin()), 0};
    }
    made_.graph->connections.push_back(c);
  }
}

void OnlyTasks::add_source(const Graph& graph, const End& from, const Type& type) {
  const std::string name = end_name(graph, from, true);
  for (const Communicator& c : made_.graph->communicators)
    if (c.name == name) return;
  const ReadTopic* const topic = recording_.find(name);
  if (topic == nullptr || topic->schema != schema_of(type).text)
    throw InputError("--only: the recording has no values of '" + name +
                     "', which they read; record all that is published: jarol run --record");
  Communicator source{.name = name,
                      .where = {},
                      .direction = Direction::in,
                      .type = &type,
                      .init = Value(type),
                      .timeout = {},
                      .safe = {},
                      .distributer = 0,
                      .channel = recorded_.channels.size()};
  if (from.kind == End::Kind::task) {
    const Task& task = graph.tasks[from.index];
    const TypeField& field = task.task_class->out->fields[from.field];
    source.period = task.period;
    source.offset = (task.offset + task.let.value_or(Duration{})) % task.period;
    copy_value(type, source.init.data(), static_cast<const std::byte*>(task.out.data()) + field.offset);
  } else {
    const Communicator& communicator = graph.communicators[from.index];
    source.period = communicator.period;
    source.offset = communicator.offset;
    copy_value(type, source.init.data(), communicator.init.data());
  }
  recorded_.channels.push_back({name, Direction::in, &type, ""});
  made_.graph->communicators.push_back(std::move(source));
}

Loaded OnlyTasks::take() { return std::move(made_); }

std::vector<Miss> OnlyTasks::misses_of(const std::vector<Miss>& misses) const {
  std::vector<Miss> of_kept;
  for (Miss miss : misses) {
    if (kept_[miss.task] == none) continue;
    miss.task = static_cast<std::uint32_t>(kept_[miss.task]);
    of_kept.push_back(miss);
  }
  return of_kept;
}

}  // namespace jarol

// A recording as trace events, the JSON that Perfetto and Chrome's tracing open (Trace Event Format, Duca and
// Sinclair 2016): "X" is a span, "i" an instant, "M" names a track; times are microseconds.
#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "runtime/files/atomic_file.h"
#include "runtime/record/recorded_run.h"
#include "tools/commands/log/break_note.h"
#include "tools/commands/log/log_commands.h"
#include "tools/commands/log/recorded_graph.h"
#include "tools/commands/run/apart.h"
#include "tools/report/exit_code.h"

namespace jarol::tools {
namespace {

using Json = nlohmann::ordered_json;

constexpr int logical = 1, physical = 2;  // "processes", each with a track for each task

std::string text_of(const Json& json) { return json.dump(-1, ' ', true, Json::error_handler_t::replace); }

// Exact: a double has no room for the nanoseconds of long runs.
std::string microseconds(Duration time) {
  const std::int64_t ns = time.count();
  return fmt::format("{}.{:03}", ns / 1000, ns % 1000);
}

class Events {
 public:
  explicit Events(const std::string& path) {
    if (path != "-") file_ = std::make_unique<AtomicFile>(path);
    put("{\"displayTimeUnit\":\"ns\",\"traceEvents\":[");
  }
  void name(const char* what, int pid, std::size_t tid, const Json& args) {
    begin(fmt::format("{{\"ph\":\"M\",\"pid\":{},\"tid\":{},\"name\":\"{}\"", pid, tid, what), args);
  }
  void span(int pid, std::size_t tid, const char* category, const std::string& name, Duration from, Duration length,
            const Json& args = {}) {
    begin(fmt::format(R"({{"ph":"X","pid":{},"tid":{},"cat":"{}","name":{},"ts":{},"dur":{})", pid, tid, category,
                      text_of(name), microseconds(from), microseconds(length)),
          args);
  }
  // `scope`: t, the task's track; g, all of them
  void instant(int pid, std::size_t tid, const char* category, char scope, const std::string& name, Duration at,
               const Json& args = {}) {
    begin(fmt::format(R"({{"ph":"i","s":"{}","pid":{},"tid":{},"cat":"{}","name":{},"ts":{})", scope, pid, tid,
                      category, text_of(name), microseconds(at)),
          args);
  }
  void end(const Json& about) {
    put("\n],\"otherData\":" + text_of(about) + "}\n");
    if (file_) file_->commit();
  }

 private:
  void begin(const std::string& event, const Json& args) {
    put((any_ ? ",\n" : "\n") + event + (args.empty() ? "" : ",\"args\":" + text_of(args)) + "}");
    any_ = true;
  }
  void put(const std::string& text) {
    if (file_)
      file_->write(text);
    else
      std::cout << text;
  }

  std::unique_ptr<AtomicFile> file_;
  bool any_ = false;
};

void name_tracks(Events& events, const Graph& graph, int pid, const std::string& name) {
  events.name("process_name", pid, 0, {{"name", name}});
  events.name("process_sort_index", pid, 0, {{"sort_index", pid}});
  for (std::size_t i = 0; i < graph.order.size(); ++i) {
    const std::size_t tid = graph.order[i] + 1;
    events.name("thread_name", pid, tid, {{"name", graph.tasks[graph.order[i]].name}});
    events.name("thread_sort_index", pid, tid, {{"sort_index", i}});
  }
}

using Activations = std::set<std::pair<std::size_t, std::int64_t>>;  // task and number

// The releases that were left out as an activation before them still ran.
Activations left_out_in(const std::vector<Miss>& misses) {
  Activations left_out;
  for (const Miss& miss : misses)
    if (miss.left_out != 0) left_out.emplace(miss.task, miss.activation);
  return left_out;
}

// Those that a task with 'skip' left out after a fault, beside these.
Activations skipped_in(const Graph& graph, const Activations& left_out, const std::vector<TimedEvent>& events) {
  Activations skipped;
  std::map<std::string_view, std::size_t> tasks;
  for (std::size_t i = 0; i < graph.tasks.size(); ++i)
    if (graph.tasks[i].on_fault == OnFault::skip) tasks.emplace(graph.tasks[i].name, i);
  for (const TimedEvent& event : events) {
    const auto task = tasks.find(event.task);
    if (event.kind != RunEvent::Kind::fault || task == tasks.end()) continue;
    if (left_out.contains({task->second, event.activation})) continue;
    if (const std::pair next(task->second, event.activation + 1); !left_out.contains(next)) skipped.insert(next);
  }
  return skipped;
}

// Each release, with its LET where it has one and ran.
void add_releases(Events& events, const Graph& graph, Duration begin, Duration end, const Activations& left_out,
                  const Activations& skipped) {
  for (std::size_t i = 0; i < graph.tasks.size(); ++i) {
    const Task& task = graph.tasks[i];
    const std::int64_t count = releases_before(task, end);
    for (std::int64_t k = releases_before(task, begin); k < count; ++k) {
      const std::string name = fmt::format("{} {}", task.name, k);
      if (skipped.contains({i, k}))
        events.instant(logical, i + 1, "skip", 't', name + " is skipped", release_of(task, k));
      else if (left_out.contains({i, k}))
        events.instant(logical, i + 1, "skip", 't', name + " is left out", release_of(task, k));
      else if (task.let)
        events.span(logical, i + 1, "let", name, release_of(task, k), *task.let);
      else
        events.instant(logical, i + 1, "release", 't', name, release_of(task, k));
    }
  }
}

void add_misses(Events& events, const Graph& graph, const std::vector<Miss>& misses) {
  for (const Miss& miss : misses) {
    const Task& task = graph.tasks[miss.task];
    const Duration release = release_of(task, miss.activation);
    const std::string name = fmt::format("{} {}", task.name, miss.activation);
    const Json args{{"activation", miss.activation}, {"deadline_ns", task.deadline.count()}};
    if (miss.left_out != 0)
      events.instant(physical, miss.task + 1, "miss", 't', name + " is left out", release, args);
    else if (miss.ended_after == Miss::unknown)
      events.instant(physical, miss.task + 1, "miss", 't', name + " has not ended", release + task.deadline, args);
    else
      events.span(physical, miss.task + 1, "miss", name + " is late", release, Duration(miss.ended_after), args);
  }
}

void add_events(Events& events, const Graph& graph, const RecordedEvents& recorded) {
  std::map<std::string_view, std::size_t> tasks;
  for (std::size_t i = 0; i < graph.tasks.size(); ++i) tasks.emplace(graph.tasks[i].name, i);
  for (const TimedEvent& event : recorded.events) {
    switch (event.kind) {
      case RunEvent::Kind::fault: {
        const auto task = tasks.find(event.task);
        events.instant(logical, task == tasks.end() ? 0 : task->second + 1, "fault", 't', "fault: " + event.cause,
                       event.instant, {{"task", event.task}, {"activation", event.activation}});
        break;
      }
      case RunEvent::Kind::rest_begun:
      case RunEvent::Kind::at_rest:
      case RunEvent::Kind::mishap: events.instant(logical, 0, "event", 'g', words_of(event), event.instant); break;
    }
  }
}

}  // namespace

int log_trace(const LogOptions& options) {
  RecordedRun run(options.file);
  const Recording& recording = run.recording();
  const int exit_code = note_break(recording, options.file);
  require_apart({{"FILE", options.file}, {"GRAPH", options.other}}, {{"--out", options.out}});
  const Loaded loaded = load_recorded_graph(recording, options.other, "jarol log trace", false);
  const Graph& graph = *loaded.graph;
  const std::vector<Miss> misses = run.begin(graph);
  const RecordedEvents recorded = read_events(recording);
  const bool has_physical = run.header().clock == "real" || !misses.empty();  // misses: also with --execution

  Events events(options.out.empty() ? "-" : options.out);
  name_tracks(events, graph, logical, "logical time");
  if (has_physical) name_tracks(events, graph, physical, "physical time, of activations that missed their deadline");
  const Activations left_out = left_out_in(misses);
  add_releases(events, graph, run.header().begin, run.covered(), left_out,
               skipped_in(graph, left_out, recorded.events));
  add_misses(events, graph, misses);
  add_events(events, graph, recorded);
  for (const Gap& gap : run.gaps())
    events.span(logical, 0, "gap", fmt::format("{} published values are not recorded", gap.values), Duration(gap.from),
                Duration(gap.to - gap.from));
  events.end({{"schema", "jarol.log_trace/1"},
              {"graph", graph.name},
              {"clock", run.header().clock},
              {"covered_ns", run.covered().count()},
              {"digest", run.end() ? Json(fmt::format("0x{:016x}", run.end()->digest)) : Json()},
              {"events_left_out", recorded.more}});
  return exit_code;
}

}  // namespace jarol::tools

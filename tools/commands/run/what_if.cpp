#include "tools/commands/run/what_if.h"

#include <algorithm>
#include <numbers>

#include "distributers/session/execution.h"
#include "graph/language/problems.h"
#include "graph/model/condition.h"
#include "graph/text/errors.h"
#include "graph/text/escape.h"
#include "runtime/execute/executor_run.h"
#include "tools/commands/run/interrupt.h"
#include "tools/commands/run/load_graph.h"
#include "tools/report/duration_option.h"
#include "tools/report/tracking.h"

namespace jarol::tools {
namespace {

constexpr std::string_view example = "; write it as in 'at=30s set=tasks.depth.parameters.kp=0.2'";

WhatIf parse_what_if(const std::string& words) {
  const auto fail = [&](const std::string& wrong) -> InputError {
    return InputError("--what-if: '" + words + "' " + wrong + std::string(example));
  };
  std::vector<std::size_t> sets;
  for (std::size_t at = words.find(" set="); at != std::string::npos; at = words.find(" set=", at + 1))
    sets.push_back(at);
  if (!words.starts_with("at=") || sets.empty()) throw fail("does not say when and what");
  WhatIf made;
  made.at = duration_of("--what-if", words.substr(3, sets.front() - 3));
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const std::size_t begin = sets[i] + 5, end = i + 1 < sets.size() ? sets[i + 1] : words.size();
    made.set.push_back(words.substr(begin, end - begin));
    if (!sets_parameters(made.set.back()) || made.set.back().find('=') == std::string::npos)
      throw fail("sets '" + made.set.back() + "', which is no parameter of a task");
  }
  return made;
}

RunColumn::Reached shown(std::string title, const Leaf& leaf, const void* value, bool is_true) {
  const double number = expect::read_number(leaf, value);
  if (leaf.unit == "rad") return {std::move(title), "deg", number * 180 / std::numbers::pi, is_true};
  return {std::move(title), leaf.unit, number, is_true};
}

}  // namespace

std::vector<WhatIf> parse_what_ifs(const std::vector<std::string>& words) {
  if (words.size() > WhatIf::max_count)
    throw InputError("--what-if: there are " + std::to_string(words.size()) + " of them, and at most " +
                     std::to_string(WhatIf::max_count) + " stand side by side");
  std::vector<WhatIf> all;
  for (const std::string& each : words) all.push_back(parse_what_if(each));
  return all;
}

std::string to_text(const WhatIf& what_if) {
  std::string text = "at " + seconds_text(what_if.at) + " s";
  for (const std::string& set : what_if.set) text += " " + printable(set);
  return text;
}

RunColumn column_of(const RunState& state, const Report& report, const std::vector<TrueState>& truth,
                    const RunVerdict& verdict) {
  const Graph& graph = state.plan.graph;
  RunColumn column{.digest = report.digest, .fault_count = report.fault_count, .verdict = verdict};
  if (report.stopped) column.stopped = to_text(report.faults.back());
  for (const Reported& r : find_reported(graph)) {
    if (!r.command) continue;
    column.reached.push_back(shown(r.title, r.leaf, state.last[r.communicator], false));
    if (truth.size() != 1) continue;  // of several vehicles nobody knows whose is meant
    const Value& values = truth.front().values;
    for (const Leaf& leaf : leaves_of(*values.type()))
      if (leaf.path == r.leaf.path && leaf.unit == r.leaf.unit)
        column.reached.push_back(shown(r.title, leaf, values.data(), true));
  }
  return column;
}

void WhatIfs::prepare(const Graph& graph, std::string file, Overrides overrides, std::uint64_t seed,
                      std::size_t workers, std::string execution, Duration end) {
  if (what_ifs_.empty()) return;
  file_ = std::move(file);
  overrides_ = std::move(overrides);
  seed_ = seed;
  workers_ = workers;
  execution_ = std::move(execution);
  end_ = end;
  Overrides with;
  for (const WhatIf& what_if : what_ifs_) load(what_if, with);
  const auto earlier = [](const WhatIf& a, const WhatIf& b) { return a.at < b.at; };
  kept_.emplace(outputs_of(graph), std::min_element(what_ifs_.begin(), what_ifs_.end(), earlier)->at);
}

void WhatIfs::add_to(std::vector<RecordSink*>& sinks) {
  if (kept_) sinks.push_back(&*kept_);
}

void WhatIfs::add_to(std::vector<Stop>& stops) {
  for (WhatIf& what_if : what_ifs_)
    stops.push_back({"--what-if", what_if.at, [&what_if](const Checkpoint& checkpoint) { what_if.past = checkpoint; },
                     "what if " + to_text(what_if) + " is not run"});
}

void WhatIfs::run(RunSinks& sinks, RunFiles& files) {
  if (what_ifs_.empty()) return;
  sinks.catch_up();
  if (const std::string failure = sinks.why_not_all(*kept_); !failure.empty())
    throw Unfinished("what-ifs are not run, as the run is not kept to compare them with: " + failure);
  for (std::size_t i = 0; i < what_ifs_.size(); ++i) {
    if (!what_ifs_[i].past) continue;  // which was said
    if (Interruptible::signal() != 0)
      throw Unfinished("what if " + to_text(what_ifs_[i]) + " is not run, as " +
                       Ending::of_signal(Interruptible::signal()).reason);
    const auto beside = files.beside("what if " + std::to_string(i + 1));
    outcomes_.push_back(run(what_ifs_[i], beside.get()));
  }
}

Loaded WhatIfs::load(const WhatIf& what_if, Overrides& overrides) const {
  overrides = overrides_;
  overrides.set.insert(overrides.set.end(), what_if.set.begin(), what_if.set.end());
  try {
    return load_graph(file_, overrides, seed_);
  } catch (const SpecError& error) {  // which the run itself does not have
    const auto rename = [&](Location& where) {
      if (where.source != nullptr && where.source->name == "--set" &&
          std::find(what_if.set.begin(), what_if.set.end(), where.source->text) != what_if.set.end())
        where.source = std::make_shared<const Source>(Source{"--what-if", where.source->text});
    };
    std::vector<Problem> problems = error.problems();
    for (Problem& problem : problems) {
      rename(problem.where);
      for (Note& note : problem.notes) rename(note.where);
    }
    throw SpecError(std::move(problems));
  }
}

WhatIfOutcome WhatIfs::run(const WhatIf& what_if, RecordSink* beside) const {
  Overrides overrides;
  Loaded loaded = load(what_if, overrides);
  RunOrigin origin = origin_of(loaded, overrides, seed_);
  ComparedValues compared(*kept_, what_if.at);
  std::vector<RecordSink*> sinks{&compared};
  if (beside != nullptr) sinks.push_back(beside);
  Execution execution(execution_, *loaded.graph, seed_, "--execution");
  GraphRun other(std::move(loaded),
                 {.sinks = sinks, .workers = workers_, .schedule = execution.schedule(), .times = execution.times()});
  other.set_origin(std::move(origin));
  other.require_same_origin(*what_if.past);
  other.restore(*what_if.past);
  other.connect([](const std::string&) {});  // the run has said what is to be noted
  ExecutorRun attended(other.executor(), end_);
  const RunEnd end = attend(
      attended, [] {}, Interruptible::wish);
  if (end.failure) std::rethrow_exception(end.failure);
  if (end.hangs) throw Unfinished("what if " + to_text(what_if) + ": a task does not end");
  // what there is of it is no outcome
  if (end.ending.cause == Ending::Cause::signal)
    throw Unfinished("what if " + to_text(what_if) + " is not run to its end, as " + end.ending.reason);
  other.disconnect();
  other.sinks().close();
  const std::vector<TrueState> truth = find_true_states(other.graph(), other.channels());
  return {what_if, column_of(other.executor().state(), other.executor().report(), truth, other.judge(end_, end)),
          compared.differences()};
}

}  // namespace jarol::tools

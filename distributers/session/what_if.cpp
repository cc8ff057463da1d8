#include "distributers/session/what_if.h"

#include <algorithm>

#include "distributers/session/execution.h"
#include "graph/language/problems.h"
#include "graph/language/quantities.h"
#include "graph/text/errors.h"
#include "graph/text/escape.h"
#include "runtime/execute/executor_run.h"

namespace jarol {

std::string to_text(const WhatIf& what_if) {
  std::string text = "at " + seconds_text(what_if.at) + " s";
  for (const std::string& set : what_if.set) text += " " + printable(set);
  return text;
}

WhatIfs::WhatIfs(std::vector<WhatIf> what_ifs, WhatIfSetup setup, const Graph& graph)
    : what_ifs_(std::move(what_ifs)), setup_(std::move(setup)) {
  if (what_ifs_.empty()) return;
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
    stops.push_back({setup_.option, what_if.at, [&what_if](const Checkpoint& checkpoint) { what_if.past = checkpoint; },
                     "what if " + to_text(what_if) + " is not run"});
}

void WhatIfs::run(RunSinks& sinks, const MakeSink& make_sink, const std::function<Wish()>& wish) {
  if (what_ifs_.empty()) return;
  sinks.catch_up();
  if (const std::string failure = sinks.why_not_all(*kept_); !failure.empty())
    throw Unfinished("what-ifs are not run, as the run is not kept to compare them with: " + failure);
  for (std::size_t i = 0; i < what_ifs_.size(); ++i) {
    if (!what_ifs_[i].past) continue;  // which was said
    if (const int signal = wish().signal; signal != 0)
      throw Unfinished("what if " + to_text(what_ifs_[i]) + " is not run, as " + Ending::of_signal(signal).reason);
    const auto beside = make_sink(i);
    outcomes_.push_back(run(what_ifs_[i], beside.get(), wish));
  }
}

Loaded WhatIfs::load(const WhatIf& what_if, Overrides& overrides) const {
  overrides = setup_.overrides;
  overrides.set.insert(overrides.set.end(), what_if.set.begin(), what_if.set.end());
  try {
    return setup_.load(overrides);
  } catch (const SpecError& error) {  // which the run itself does not have
    const auto rename = [&](Location& where) {
      if (where.source != nullptr && where.source->name == "--set" &&
          std::find(what_if.set.begin(), what_if.set.end(), where.source->text) != what_if.set.end())
        where.source = std::make_shared<const Source>(Source{setup_.option, where.source->text});
    };
    std::vector<Problem> problems = error.problems();
    for (Problem& problem : problems) {
      rename(problem.where);
      for (Note& note : problem.notes) rename(note.where);
    }
    throw SpecError(std::move(problems));
  }
}

WhatIfOutcome WhatIfs::run(const WhatIf& what_if, RecordSink* beside, const std::function<Wish()>& wish) const {
  Overrides overrides;
  Loaded loaded = load(what_if, overrides);
  RunOrigin origin = origin_of(loaded, overrides, setup_.seed);
  ComparedValues compared(*kept_, what_if.at);
  std::vector<RecordSink*> sinks{&compared};
  if (beside != nullptr) sinks.push_back(beside);
  Execution execution(setup_.execution, *loaded.graph, setup_.seed, setup_.execution_option);
  GraphRun other(
      std::move(loaded),
      {.sinks = sinks, .workers = setup_.workers, .schedule = execution.schedule(), .times = execution.times()});
  other.set_origin(std::move(origin));
  other.require_same_origin(*what_if.past);
  other.restore(*what_if.past);
  other.connect([](const std::string&) {});  // the run has said what is to be noted
  ExecutorRun attended(other.executor(), setup_.end);
  const RunEnd end = attend(
      attended, [] {}, wish);
  if (end.failure) std::rethrow_exception(end.failure);
  if (end.hangs) throw Unfinished("what if " + to_text(what_if) + ": a task does not end");
  // what there is of it is no outcome
  if (end.ending.cause == Ending::Cause::signal)
    throw Unfinished("what if " + to_text(what_if) + " is not run to its end, as " + end.ending.reason);
  other.disconnect();
  other.sinks().close();
  const std::vector<TrueState> truth = find_true_states(other.graph(), other.systems());
  return {what_if, column_of(other.executor().state(), other.executor().report(), truth, other.judge(setup_.end, end)),
          compared.differences()};
}

}  // namespace jarol

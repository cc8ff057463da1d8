#include "distributers/campaign/run_one.h"

#include <array>
#include <new>
#include <system_error>
#include <utility>

#include "distributers/campaign/running_run.h"
#include "distributers/session/graph_run.h"

namespace jarol::campaign {

namespace {

constexpr std::array<const char*, 5> words{"good", "bad", "fault", "lost", "refused"};

// So much logical time passes between two looks at whether to stop; in pieces it is the same run.
constexpr Duration piece = std::chrono::seconds(1);

std::string text_of(const SpecError& error) {
  std::string text;
  for (const Problem& problem : error.problems()) text += (text.empty() ? "" : "; ") + problem.text;
  return text;
}

// It says nothing of the run, but of the machine at that moment.
bool is_want_of_room(const std::exception& error) {
  // what has no size that there is has none on any machine
  if (dynamic_cast<const std::bad_array_new_length*>(&error) != nullptr) return false;
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr) return true;
  const auto* const refused = dynamic_cast<const std::system_error*>(&error);
  return refused != nullptr && (refused->code() == std::errc::resource_unavailable_try_again ||
                                refused->code() == std::errc::not_enough_memory);
}

// What a campaign can't do with those systems; empty: it can run them.
std::string wrong_with(const Graph& graph, const std::vector<std::unique_ptr<ExternalSystem>>& systems) {
  for (std::size_t i = 0; i < systems.size(); ++i)
    if (systems[i]->needs_real_clock() || systems[i]->link_report())
      return "distributer '" + graph.distributers[i].name +
             "' has a link to another process; a campaign runs vehicles and scripts that are simulated in its own";
  return "";
}

// All that is against the run.
void add_failures(std::vector<Failure>& failures, const RunVerdict& verdict) {
  for (const auto& mishap : verdict.mishaps)
    failures.push_back({"the vehicle of '" + mishap.distributer + "'", mishap.text, jarol::to_text(mishap)});
  for (const std::string& line : verdict.left_out)
    failures.push_back({line.substr(0, line.find(" gave nothing")), "gave nothing", line});
  if (!verdict.not_at_rest.empty()) failures.push_back({"not at rest", "", verdict.not_at_rest});
  for (const Verdict& v : verdict.expectations)
    if (v.outcome == Verdict::Outcome::fails)
      failures.push_back({"expected '" + v.condition + "'", "", "expected '" + v.condition + "', but it " + v.why});
}

// Conditions that say nothing of the run.
void add_not_judged(Result& result, const RunVerdict& verdict) {
  std::string why;
  for (const Verdict& v : verdict.expectations) {
    if (v.outcome != Verdict::Outcome::not_judged) continue;
    ++result.not_judged;
    if (why.empty()) why = v.why;
  }
  if (result.not_judged > 0 && result.outcome == Outcome::good)
    result.why = std::to_string(result.not_judged) +
                 (result.not_judged > 1 ? " conditions were not judged: " : " condition was not judged: ") + why;
}

// `whole`: the run came to its end; of another one there is what an instant or a broken limit decided.
Reached reached_of(const Metric& metric, const expect::Condition& condition, const Verdict& verdict, bool whole) {
  const bool decided = verdict.outcome != Verdict::Outcome::not_judged && (whole || metric.is_limit);
  if (!decided && !metric.is_instant) return {};
  if (condition.kind != expect::Condition::Kind::metric) {
    if (!verdict.instant) return {};
    return {std::chrono::duration<double>(*verdict.instant).count(), ""};
  }
  const Type* type = condition.metric.value.type;
  const bool is_word = type != nullptr && (type->kind == Kind::enumeration || type->kind == Kind::boolean);
  if (is_word && verdict.reached) return {std::nullopt, verdict.reached_text};
  return {verdict.reached, ""};
}

void measure(const Measures& measures, const std::vector<Verdict>& verdicts, Result& result) {
  result.metrics.resize(measures.metrics.size());
  const bool whole = result.outcome == Outcome::good || result.outcome == Outcome::bad;
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    const Metric& metric = measures.metrics[i];
    result.metrics[i] = reached_of(metric, measures.conditions[i], verdicts[i], whole);
    if (!metric.is_limit || verdicts[i].outcome != Verdict::Outcome::fails) continue;
    const std::string what = "metric '" + metric.name + "'";
    result.failures.push_back({what, "", what + " is beyond its limit: it " + verdicts[i].why});
  }
}

class CampaignRun {
 public:
  CampaignRun(const MeasuredGraph& of, RunStart start, std::optional<Duration> length)
      : of_(of),
        run_(of.graph, std::move(start), {.measured = of.measures.conditions}),
        end_(length.value_or(end_of_mission(run_.systems()))) {}

  // False: it was to stop.
  bool cover(Result& result, const Oversight& oversight) {
    Executor& executor = run_.executor();
    const StuckRuns::Watched watched(oversight.stuck, result.index, executor);
    try {
      run_.connect(no_notes);
      while (executor.now() < end_ && !executor.report().stopped) {
        if (oversight.stop.load(std::memory_order_relaxed)) return false;
        executor.run_until(std::min(end_, executor.now() + piece));
      }
    } catch (const std::exception& error) {
      if (is_want_of_room(error)) throw;
      lose(result, error.what());
    } catch (...) { lose(result, "something was thrown that is no exception"); }
    return true;
  }

  void judge(Result& result) {
    run_.disconnect();
    close_sinks();
    const Report& report = run_.executor().report();
    result.simulated = report.simulated;
    result.faults = report.fault_count;
    result.digest = report.digest;
    RunEnd end;
    end.ending = result.outcome == Outcome::lost ? Ending::lost() : report.stopped ? Ending::fault() : Ending::over();
    if (result.outcome == Outcome::good && report.stopped) {
      const Fault& fault = report.faults.back();
      result.outcome = Outcome::fault;
      result.failures.push_back({"task '" + fault.task + "'", fault.cause, to_text(fault)});
    }
    const RunVerdict verdict = run_.judge(end_, end);
    add_failures(result.failures, verdict);
    measure(of_.measures, run_.measure(end_), result);
    if (result.outcome == Outcome::good && !result.failures.empty()) result.outcome = Outcome::bad;
    if (!result.failures.empty()) result.why = result.failures.front().why;
    add_not_judged(result, verdict);
  }

 private:
  // Where several have failed that says more than the text of all.
  void close_sinks() {
    try {
      run_.sinks().close();
    } catch (...) {
      run_.sinks().rethrow_failure();
      throw;
    }
  }

  void lose(Result& result, const std::string& text) {
    result.outcome = Outcome::lost;
    result.failures.push_back({"lost", text, "at " + seconds_text(run_.executor().now()) + " s: " + text});
  }

  const MeasuredGraph& of_;
  GraphRun run_;
  Duration end_;
};

const char* const no_end = "it has no mission that ends; say how long a run is, as in --for 10s";

std::string why_not(const Graph& graph, const RunStart& start, std::optional<Duration> length) {
  if (std::string wrong = wrong_with(graph, start.systems); !wrong.empty()) return wrong;
  return length || end_of_mission(pointers_to(start.systems)) > Duration{} ? "" : no_end;
}

}  // namespace

const char* word_of(Outcome outcome) { return words[static_cast<std::size_t>(outcome)]; }

std::optional<Outcome> outcome_of(const std::string& word) {
  for (std::size_t i = 0; i < words.size(); ++i)
    if (word == words[i]) return static_cast<Outcome>(i);
  return std::nullopt;
}

std::string why_not_in_campaign(const PlannedGraph& graph, std::optional<Duration> length) {
  return why_not(graph.graph(), graph.start({}, 0), length);
}

std::optional<Result> run_one(Graphs& graphs, const Start& start, std::optional<Duration> length,
                              const Oversight& oversight) {
  Result result;
  result.index = start.index;
  result.metrics.resize(graphs.base().measures.metrics.size());
  const RunningRun running(start.index);
  std::optional<SourceSet> files;
  if (graphs.files()) files.emplace(*graphs.files(), "it was not there when the campaign began");
  const auto require_all_read = [&] {
    if (files && !files->missed().empty())
      throw UnreadFile("run " + std::to_string(start.index) + " needs '" + files->missed() +
                       "', which was not read before the first run; the results hold nothing of that run");
  };
  try {
    const std::shared_ptr<const MeasuredGraph> of = graphs.of(start);
    RunStart begin = of->graph.start(changes_of(start, true), start.seed);
    result.why = why_not(of->graph.graph(), begin, length);
    if (!result.why.empty()) {
      result.outcome = Outcome::refused;
      return result;
    }
    CampaignRun run(*of, std::move(begin), length);
    if (!run.cover(result, oversight)) return std::nullopt;
    run.judge(result);
  } catch (const SpecError& error) {
    require_all_read();
    result.outcome = Outcome::refused;
    result.why = text_of(error);
  } catch (const std::exception& error) {
    if (is_want_of_room(error)) throw;
    result.outcome = Outcome::lost;
    result.why = error.what();
    result.failures = {{"lost", result.why, result.why}};
  }
  return result;
}

}  // namespace jarol::campaign

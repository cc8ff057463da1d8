// A check's report for programs.
#include <nlohmann/json.hpp>

#include "graph/analysis/policies.h"
#include "graph/language/key.h"
#include "tools/commands/check/check_words.h"

namespace jarol::tools {
namespace {

using Json = nlohmann::ordered_json;

template <class T>
Json json_or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json json_or_null(const std::optional<Duration>& time) { return time ? Json(time->count()) : Json(nullptr); }

// Null where nothing was measured.
Json measured_json(const CheckReport& r) {
  if (!r.measured) return nullptr;
  auto tasks = Json::array();
  for (std::size_t i = 0; i < r.graph->tasks.size(); ++i) {
    const Task& task = r.graph->tasks[i];
    const MeasuredTask& measured = r.measured->tasks[i];
    tasks.push_back({{"name", task.name},
                     {"activations", measured.activations},
                     {"max_of_999_ns", measured.max_of_999.count()},
                     {"max_ns", measured.max.count()},
                     {"longer_than_wcet", task.wcet && measured.max > *task.wcet}});
  }
  return {{"over_ns", r.measured->over.count()},
          {"wcets_hold", longer_than_stated(r) == nullptr},
          {"tasks", std::move(tasks)}};
}

}  // namespace

nlohmann::ordered_json to_json(const CheckReport& r) {
  auto tasks = Json::array();
  for (std::size_t i = 0; i < r.graph->tasks.size(); ++i) {
    const Task& t = r.graph->tasks[i];
    const auto& response = r.result.response[i];
    Json task{{"name", t.name},
              {"period_ns", t.period.count()},
              {"offset_ns", t.offset.count()},
              {"deadline_ns", t.deadline.count()},
              {"wcet_ns", json_or_null(t.wcet)},
              {"core", json_or_null(r.result.core[i])},
              {"response_ns", json_or_null(response)},
              {"response_exact", response ? Json(static_cast<bool>(r.result.exact[i])) : Json(nullptr)},
              {"slack_ns", response ? Json((t.deadline - *response).count()) : Json(nullptr)},
              {"max_wcet_ns", r.sensitivity ? json_or_null(r.sensitivity->max_wcet[i]) : Json(nullptr)},
              {"min_deadline_ns", r.sensitivity ? json_or_null(r.sensitivity->min_deadline[i]) : Json(nullptr)}};
    tasks.push_back(std::move(task));
  }
  Json witness = nullptr;
  if (r.result.late || r.result.demand) {
    witness = Json::object();
    if (r.result.core_at_fault) witness["core"] = *r.result.core_at_fault;
    if (r.result.late) {
      const analysis::DeadlineMiss& m = *r.result.late;
      witness.update({{"task", r.graph->tasks[m.task].name},
                      {"activation", m.activation},
                      {"release_ns", m.release.count()},
                      {"finish_ns", m.ended ? Json(m.finish.count()) : Json(nullptr)},
                      {"deadline_ns", m.deadline.count()}});
      if (!m.ended) witness["unfinished_ns"] = m.finish.count();
    }
    if (r.result.demand)
      witness["demand"] = {{"length_ns", r.result.demand->length.count()},
                           {"demand_ns", r.result.demand->demand.count()},
                           {"blocking_ns", r.result.demand->blocking.count()}};
  }
  auto chains = Json::array();
  for (const analysis::CheckedChain& c : r.chains)
    chains.push_back({{"name", c.chain.name},
                      {"exact", c.latency.exact},
                      {"max_reaction_ns", c.latency.max_reaction.count()},
                      {"min_reaction_ns", c.latency.exact ? Json(c.latency.min_reaction.count()) : Json(nullptr)},
                      {"max_age_ns", c.latency.max_age.count()},
                      {"jitter_ns", c.latency.exact ? Json(c.latency.jitter.count()) : Json(nullptr)},
                      {"reaction_limit_ns", json_or_null(c.chain.reaction)},
                      {"age_limit_ns", json_or_null(c.chain.age)},
                      {"holds", json_or_null(holds(c))}});
  const Platform& platform = r.graph->platform;
  auto suggestions = Json::array();
  for (const analysis::Remedy& remedy : r.remedies) suggestions.push_back(remedy.text);
  auto sets = Json::array();
  for (const analysis::Remedy& remedy : r.remedies) sets.push_back(remedy.set);
  return {{"schema", "jarol.check/2"},
          {"file", r.file},
          {"graph", r.graph->name},
          {"cores", platform.cores},
          {"policy", analysis::policy_of(platform).name},
          {"assumptions",
           {{"text", assumption(*r.graph)},
            {"phasing", Words<Phasing>::list()[static_cast<std::size_t>(platform.phasing)]},
            {"dispatch_ns", platform.dispatch.count()},
            {"copy_ns_per_byte", platform.copy.count()}}},
          {"verdict", word_of(r.result.verdict)},
          {"limits_hold", json_or_null(chains_hold(r))},
          {"evidence", word_of(r.result.evidence)},
          {"reason", r.result.reason},
          {"witness", std::move(witness)},
          {"alpha", r.sensitivity && r.sensitivity->alpha ? Json(*r.sensitivity->alpha) : Json(nullptr)},
          {"tasks", std::move(tasks)},
          {"chains", std::move(chains)},
          {"measured", measured_json(r)},
          {"suggestions", std::move(suggestions)},
          {"suggested_sets", std::move(sets)},
          {"utilisation", r.result.utilisation}};
}

}  // namespace jarol::tools

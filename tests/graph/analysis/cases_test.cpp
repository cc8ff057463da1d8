// Published and recomputed scheduling problems (tests/data/sched-cases.json) through YAML.
#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "graph/analysis/chains.h"
#include "graph/analysis/check.h"
#include "graph/analysis/global_edf.h"
#include "graph/analysis/sensitivity.h"
#include "tests/graph/graph_of.h"

namespace {
using namespace jarol;
using namespace jarol::analysis;
using Json = nlohmann::json;

const Json& cases() {
  static const Json all = Json::parse(std::ifstream("tests/data/sched-cases.json"))["cases"];
  return all;
}

constexpr Duration unit = std::chrono::milliseconds(1);  // stands for one unit of a case

std::string name_of(std::size_t i) { return (i < 10 ? "t0" : "t") + std::to_string(i); }

std::string policy_of(const Json& c) {
  static const std::map<std::string, std::string> names{{"fp", "fixed_priority"},
                                                        {"edf", "edf"},
                                                        {"np-fp", "fixed_priority_nonpreemptive"},
                                                        {"np-edf", "edf_nonpreemptive"}};
  return names.at(c["policy"]);
}

// What the language can't say: a deadline beyond the period, and the kinds that are no periodic tasks on cores.
std::string why_not(const Json& c) {
  const std::string kind = c["kind"];
  if (kind == "jobset") return "jobs with ranges of releases and execution times are no periodic tasks";
  if (kind == "tt" || kind == "dag") return "a set of single jobs is no set of periodic tasks";
  if (kind == "sim" && c["policy"] == "fp") return "there are no global fixed priorities";
  for (const Json& t : c.value("tasks", Json::array()))
    if (t.value("D", t["T"]).get<std::int64_t>() > t["T"].get<std::int64_t>())
      return "a deadline lies beyond the period";
  return "";
}

std::string yaml_of(const Json& c, const std::string& of_unit) {
  const bool global = c["kind"] == "global-test" || c["kind"] == "sim";
  const std::string policy = global ? "global_edf" : policy_of(c);
  const bool nonpreemptive = policy.ends_with("nonpreemptive");
  std::string text = "graph: t\nplatform: {cores: " + std::to_string(c.value("m", 1)) + ", policy: " + policy +
                     (nonpreemptive ? ", phasing: any" : "") + "}\ntasks:\n";
  for (std::size_t i = 0; i < c["tasks"].size(); ++i) {
    const Json& t = c["tasks"][i];
    text += "  " + name_of(i) + ": {type: Work";
    const std::pair<const char*, const char*> keys[] = {{"C", "wcet"},     {"T", "period"}, {"O", "offset"},
                                                        {"D", "deadline"}, {"J", "jitter"}, {"B", "blocking"},
                                                        {"L", "let"}};
    for (const auto& [from, to] : keys)
      if (t.contains(from)) text += std::string(", ") + to + ": " + t[from].dump() + of_unit;
    if (t.contains("prio")) text += ", priority: " + t["prio"].dump();
    text += "}\n";
  }
  return text;
}

double fraction(const std::string& text) {
  const std::size_t slash = text.find('/');
  return slash == std::string::npos ? std::stod(text)
                                    : std::stod(text.substr(0, slash)) / std::stod(text.substr(slash + 1));
}

void check_case(const Json& c) {
  // what can't be preempted is held up by one nanosecond less than a whole WCET: there the unit is the nanosecond
  const bool small = policy_of(c).ends_with("nonpreemptive");
  const Graph graph = tests::graph_of(yaml_of(c, small ? "ns" : "ms"));
  const Duration scale = small ? Duration(1) : unit;
  const Json& expect = c["expect"];
  const System system = system_of(graph);
  const Result result = check(system);
  CHECK(result.verdict == (expect["schedulable"].get<bool>() ? Verdict::schedulable : Verdict::not_schedulable));
  CHECK(result.evidence == Evidence::proof);
  if (expect.contains("U") && !small) CHECK(result.utilisation == doctest::Approx(fraction(expect["U"])));
  const bool edf_late = policy_of(c) == "edf" && !expect["schedulable"].get<bool>();
  // published responses under EDF are over all shifts
  const bool moves = policy_of(c) == "edf" && std::none_of(system.models.begin(), system.models.end(),
                                                           [](const TaskModel& m) { return m.offset > Duration{}; });
  System shifted = system;
  shifted.offsets_hold = system.offsets_hold && !moves;
  const Result every_shift = check(shifted);
  if (expect.contains("R") && !edf_late)
    for (std::size_t i = 0; i < expect["R"].size(); ++i) {
      CAPTURE(i);
      if (expect["R"][i].is_null()) {
        CHECK(!result.response[i]);
      } else {
        REQUIRE(every_shift.response[i]);
        CHECK(*every_shift.response[i] == expect["R"][i].get<std::int64_t>() * scale);
        REQUIRE(result.response[i]);
        CHECK(*result.response[i] <= *every_shift.response[i]);
      }
    }
  if (expect.contains("first_miss")) {
    REQUIRE(result.late);
    const DeadlineMiss& m = *result.late;
    CHECK(Json{m.task, m.activation, m.release / scale, m.deadline / scale, m.finish / scale} == expect["first_miss"]);
  }
  if (policy_of(c) == "edf" && expect.contains("witness") && expect["witness"].size() == 2 &&
      expect["witness"][0].is_number()) {
    // any interval in which more is due than there is time will do
    REQUIRE(result.demand);
    CHECK(result.demand->demand > result.demand->length);
  }
  if (expect.contains("alpha") || expect.contains("max_C")) {
    Budget budget;
    const Sensitivity s = sensitivity_of(system, true, budget).value();
    if (expect.contains("alpha")) {
      REQUIRE(s.alpha);
      CHECK(*s.alpha == doctest::Approx(fraction(expect["alpha"])).scale(0).epsilon(2e-6));
    }
    if (expect.contains("max_C"))
      for (std::size_t i = 0; i < expect["max_C"].size(); ++i)
        CHECK(s.max_wcet[i].value_or(Duration{}) / scale == expect["max_C"][i].get<std::int64_t>());
  }
}

void check_chain(const Json& c) {
  std::string tasks, connections;
  for (std::size_t i = 0; i < c["chain"].size(); ++i) {
    const Json& t = c["chain"][i];
    tasks += "  " + name_of(i) + ": {type: " + (i == 0 ? "Counter" : "Relay") + ", period: " + t["T"].dump() +
             "ms, let: " + t.value("L", t["T"]).dump() + "ms, offset: " + t.value("O", Json(0)).dump() + "ms}\n";
    if (i > 0) connections += "  - " + name_of(i - 1) + ".out -> " + name_of(i) + ".in\n";
  }
  const Graph graph = tests::graph_of("graph: t\ntasks:\n" + tasks + "connections:\n" + connections);
  std::vector<End> path;
  for (std::size_t i = 0; i < graph.tasks.size(); ++i) path.push_back({End::Kind::task, i, 0});
  Budget budget;
  const ChainLatency m = latency_of(graph, path, budget);
  CHECK(m.exact);
  CHECK(m.max_reaction == c["expect"]["mrt"].get<std::int64_t>() * unit);
  CHECK(m.max_age == c["expect"]["mda"].get<std::int64_t>() * unit);
  CHECK(m.max_reduced_age == c["expect"]["mrda"].get<std::int64_t>() * unit);
  CHECK(m.bound == c["expect"]["davare"].get<std::int64_t>() * unit);
}

void check_global(const Json& c) {
  // the published bounds count in whole units
  const Graph graph = tests::graph_of(yaml_of(c, "ns"));
  const System system = system_of(graph);
  CHECK(passes_gfb(system.models, system.cores) == c["expect"]["gfb"].get<bool>());
  Budget budget;
  const auto responses = global_edf_responses(system.models, system.cores, budget);
  for (std::size_t i = 0; i < responses.size(); ++i) {
    REQUIRE(responses[i]);
    CHECK(*responses[i] == Duration(c["expect"]["R_edf"][i].get<std::int64_t>()));
  }
}

void check_walk(const Json& c) {
  const Result result = check(tests::graph_of(yaml_of(c, "ns")));
  CHECK((result.verdict == Verdict::schedulable) == c["expect"]["schedulable"].get<bool>());
  CHECK(result.evidence == Evidence::proof);
  REQUIRE(result.late);
  const DeadlineMiss& m = *result.late;
  CHECK(Json{m.task, m.activation, m.release.count(), m.deadline.count(), m.finish.count()} ==
        c["expect"]["first_miss"]);
}
}  // namespace

TEST_SUITE("graph/analysis/cases") {
  TEST_CASE("each problem that the language can say has the verdict, responses, witness and margins that are known") {
    std::size_t done = 0;
    std::map<std::string, int> left_out;
    for (const Json& c : cases()) {
      const std::string id = c["id"], kind = c["kind"];
      CAPTURE(id);
      const std::string reason = why_not(c);
      if (!reason.empty()) {
        ++left_out[reason];
        continue;
      }
      ++done;
      if (kind == "let-chain") {
        check_chain(c);
      } else if (kind == "global-test") {
        check_global(c);
      } else if (kind == "sim") {
        check_walk(c);
      } else {
        check_case(c);
      }
    }
    CHECK(done == 59);
    CHECK(left_out ==
          std::map<std::string, int>{{"a deadline lies beyond the period", 5},
                                     {"a set of single jobs is no set of periodic tasks", 11},
                                     {"there are no global fixed priorities", 1},
                                     {"jobs with ranges of releases and execution times are no periodic tasks", 13}});
  }
}

// Everything that can be said of a platform, of graphs of every kind: a verdict that fits, and a report of it.
#include "tools/commands/check/check_report.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "graph/analysis/random_graphs.h"
#include "graph/analysis/time_line.h"
#include "graph/language/key.h"
#include "graph/model/build.h"
#include "tests/how_many.h"
#include "tools/commands/check/gantt.h"
#include "tools/library/built_in.h"

namespace {
using namespace jarol;
using namespace jarol::tools;
using analysis::Verdict;

// With what its file says, but no vehicle, link or plugin.
Graph graph_of(const std::shared_ptr<const Source>& source, const Overrides& overrides) {
  Problems problems;
  Graph graph = build_graph(load_spec(source, overrides, problems), built_in().graph, problems);
  problems.throw_if_any();
  return graph;
}

// Every annotation that the analysis knows.
const std::string annotated = R"(graph: annotated
communicators:
  i: {type: double, direction: in, period: 10ms}
  o: {type: double, direction: out, period: 10ms, offset: 4ms}
tasks:
  a: {type: Relay, period: 10ms, wcet: 500us, jitter: 200us, blocking: 100us}
  b: {type: Relay, period: 10ms, wcet: 300us, deadline: 2ms}
  c: {type: Relay, period: 20ms, offset: 3ms, let: 12ms, wcet: 2ms, priority: 1}
  d: {type: Counter, period: 35ms, offset: 1ms, wcet: 4ms, blocking: 1ms}
  e: {type: Counter, period: 5ms, let: 5ms, wcet: 1ms, core: 0}
connections: [i -> a.in, a.out -> b.in, b.out -> o, b.out -> c.in]
chains:
  loop: {path: [i, a, b, o], reaction: 20ms, crossover: 2Hz}
  tight: {path: [a, b, c], age: 1ms}
)";

std::vector<std::shared_ptr<const Source>> graphs() {
  std::vector<std::shared_ptr<const Source>> all;
  for (const char* name : {"counting", "exolauv", "exolauv_bare", "javiator", "passthrough", "window"}) {
    if (tests::tries_less && name != std::string("counting")) continue;  // they take longest
    all.push_back(read_source("specs/" + std::string(name) + ".yaml"));
  }
  const auto add = [&](const std::string& name, const std::string& text) {
    all.push_back(std::make_shared<Source>(Source{name, text}));
  };
  add("annotated", annotated);
  add("no tasks",
      "{graph: t, communicators: {i: {type: double, direction: in, period: 1s}, "
      "o: {type: double, direction: out, period: 1s}}, connections: [i -> o]}");
  add("no wcet", "{graph: t, tasks: {a: {type: Counter, period: 1s}, b: {type: Counter, period: 1s, wcet: 1ms}}}");
  add("full",
      "{graph: t, tasks: {a: {type: Counter, period: 2ms, wcet: 1ms}, b: {type: Work, period: 4ms, wcet: 2ms}}}");
  add("too much",
      "{graph: t, tasks: {a: {type: Counter, period: 2ms, wcet: 7ms}, b: {type: Work, period: 4ms, wcet: 2s}}}");
  if (tests::is_full()) {
    add("prime",
        "{graph: t, tasks: {a: {type: Counter, period: 999983ns, wcet: 1us}, b: {type: Work, period: 99999989ns, "
        "wcet: 9ms, core: 0}, c: {type: Work, period: 10000019us, wcet: 80ms, offset: 1ns}}}");
    add("decades",
        "{graph: t, tasks: {a: {type: Counter, period: 87600h, wcet: 87600h, jitter: 87600h}, b: {type: "
        "Work, period: 87600h, offset: 87599h, wcet: 1h, blocking: 87600h}, c: {type: Work, period: 1s, "
        "wcet: 87600h, blocking: 87600h, jitter: 87600h}}}");
  }
  for (const char* kind : {"waters", "uunifast"})
    for (const double utilisation : {0.6, 1.4}) {
      if (!tests::is_full() && kind == std::string("waters")) continue;
      const analysis::Generation generation{kind, 7, 6, utilisation, 1, "table"};
      add(kind + std::to_string(utilisation), analysis::generate_graph(generation));
    }
  return all;
}

// With JAROL_FULL also those that are beyond everything, which takes minutes.
std::vector<std::string> overheads() {
  std::vector<std::string> all{"", "platform={dispatch: 5us, copy: 3us}"};
  if (tests::is_full()) all.insert(all.end(), {"platform.dispatch=87600h", "platform.copy=87600h"});
  return all;
}

void check_verdict(const CheckReport& r) {
  const std::size_t n = r.graph->tasks.size();
  REQUIRE(r.result.response.size() == n);
  REQUIRE(r.result.core.size() == n);
  CHECK(!r.result.reason.empty());
  CHECK((r.result.evidence == analysis::Evidence::none) == (r.result.verdict == Verdict::unknown));
  for (std::size_t i = 0; i < n; ++i) {
    const Task& t = r.graph->tasks[i];
    if (r.result.core[i]) CHECK(static_cast<std::int64_t>(*r.result.core[i]) < r.graph->platform.cores);
    if (r.result.core[i] && t.core) CHECK(static_cast<std::int64_t>(*r.result.core[i]) == *t.core);
    if (!r.result.response[i]) continue;
    CHECK(*r.result.response[i] >= *t.wcet);
    if (r.result.verdict == Verdict::schedulable) CHECK(*r.result.response[i] <= t.deadline);
  }
  if (r.result.late) {
    CHECK(r.result.verdict != Verdict::schedulable);
    CHECK(r.result.late->finish > r.result.late->deadline);
    CHECK(r.result.late->deadline > r.result.late->release);
    const std::string picture = gantt_svg(*r.graph, r.result);
    CHECK(picture.starts_with("<svg "));
    CHECK(picture.ends_with("</svg>\n"));
    CHECK(picture.find("nan") == std::string::npos);
  }
}

// What people look at agrees with the verdict, which rests on other code.
void check_time_line(const CheckReport& r) {
  if (r.result.verdict != Verdict::schedulable) return;
  const auto line = jarol::analysis::time_line_of(jarol::analysis::system_of(*r.graph), r.result);
  for (const jarol::analysis::Slice& s : line.slices) {
    const Task& t = r.graph->tasks[s.task];
    const Duration release = t.offset + s.activation * t.period;
    CHECK(s.begin >= release);
    CHECK(s.end <= release + t.deadline);
    if (r.result.response[s.task]) CHECK(s.end - release <= *r.result.response[s.task]);
  }
  const std::string picture = gantt_svg(*r.graph, r.result);
  CHECK((picture.starts_with("<svg ") && picture.ends_with("</svg>\n")) == !r.graph->tasks.empty());
}

void check_texts(const CheckReport& r) {
  const std::string text = to_text(r);
  const std::string word = r.result.verdict == Verdict::schedulable       ? "SCHEDULABLE"
                           : r.result.verdict == Verdict::not_schedulable ? "NOT SCHEDULABLE"
                                                                          : "UNKNOWN";
  CHECK((text.starts_with("file: " + word + " ") || text.starts_with("file: " + word + "\n")));
  for (const Task& t : r.graph->tasks) CHECK(text.find("\n  " + t.name + " ") != std::string::npos);
  for (const char* wrong : {" nan", " inf", "nan%", "inf%", "please report"})
    CHECK(text.find(wrong) == std::string::npos);
  const auto reported = to_json(r);
  CHECK(reported["verdict"] == (word == "NOT SCHEDULABLE" ? "not_schedulable"
                                : word == "UNKNOWN"       ? "unknown"
                                                          : "schedulable"));
  CHECK(reported["tasks"].size() == r.graph->tasks.size());
  CHECK(reported["chains"].size() == r.chains.size());
  CHECK(nlohmann::ordered_json::parse(reported.dump()) == reported);
}

// What holds for every shift of the tasks holds for the one that is given.
void check_phasing(const Policy& policy, Verdict given, Verdict any) {
  if (policy == policies::table) CHECK(any == Verdict::unknown);
  if (any == Verdict::schedulable) CHECK(given == Verdict::schedulable);
  if (given == Verdict::not_schedulable) CHECK(any != Verdict::schedulable);
}
}  // namespace

TEST_SUITE("tools/check_graph") {
  TEST_CASE("every policy, phasing, number of cores and overhead gives a verdict and a report of every kind of graph") {
    for (const auto& source : graphs())
      for (const Policy& policy : built_in().graph.policies())
        for (const char* cores : {"1", "3"})
          for (const std::string& overhead : overheads()) {
            if (tests::tries_less && !overhead.empty() && cores == std::string("3")) continue;
            std::vector<Verdict> verdicts;
            for (const std::string& phasing : Words<Phasing>::list()) {
              Overrides overrides{"",
                                  {"platform.policy=" + std::string(policy.name),
                                   "platform.cores=" + std::string(cores), "platform.phasing=" + phasing}};
              if (!overhead.empty()) overrides.set.insert(overrides.set.begin(), overhead);
              std::string made = source->name;
              for (const std::string& set : overrides.set) made += " " + set;
              CAPTURE(made);
              const Graph graph = graph_of(source, overrides);
              const CheckReport report("file", analysis::check_graph(graph, false, true));
              check_verdict(report);
              check_texts(report);
              check_time_line(report);
              analysis::Budget budget;
              if (!report.result.reason.starts_with("no 'wcet'")) {
                const analysis::Verdict of_system = analysis::verdict_of(analysis::system_of(graph), budget);
                const bool is_open =
                    of_system == analysis::Verdict::schedulable && !analysis::open_deadline(graph).empty();
                CHECK((is_open ? analysis::Verdict::unknown : of_system) == report.result.verdict);
              }
              verdicts.push_back(report.result.verdict);
            }
            check_phasing(policy, verdicts[0], verdicts[1]);
          }
  }

  TEST_CASE("of all paths those that lead to no output are not walked, however many there are") {
    std::string tasks = "tasks:\n  s0: {type: Relay}\n",
                connections = "connections:\n  - i -> s0.in\n  - s0.out -> o\n";
    for (int i = 0; i < 40; ++i) {  // each splits into two ways, which meet again
      const std::string n = std::to_string(i), next = "s" + std::to_string(i + 1);
      tasks += "  l" + n + ": {type: Relay}\n  r" + n + ": {type: Relay}\n  " + next + ": {type: Sum}\n";
      connections += "  - s" + n + ".out -> l" + n + ".in\n  - s" + n + ".out -> r" + n + ".in\n  - l" + n +
                     ".out -> " + next + ".a\n  - r" + n + ".out -> " + next + ".b\n";
    }
    const std::string text =
        "graph: ways\ntiming: {period: 10ms}\ncommunicators:\n  i: {type: double, direction: in}\n"
        "  o: {type: double, direction: out}\n" +
        tasks + connections;
    const Graph graph = graph_of(std::make_shared<Source>(Source{"ways", text}), {});
    const CheckReport report("ways", analysis::check_graph(graph, false, true));
    REQUIRE(report.chains.size() == 1);
    CHECK(report.chains[0].chain.name == "i -> s0 -> o");
    CHECK_FALSE(report.more_paths);
  }
}

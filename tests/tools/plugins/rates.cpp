#include "graph/language/quantities.h"
#include "graph/plugins/plugin_grammar.h"

namespace {
using namespace jarol;

struct Rates {
  static constexpr std::string_view name = "rates";
  static constexpr std::string_view how = "tasks state how often they run in the graph's period";
  static constexpr GrammarKey keys[] = {
      {"tasks", "runs", "so often in the graph's period, as in 4; the period follows, and the LET is all of it"}};

  static void lower_task(Yaml& task, Duration whole, Problems& problems) {
    const Yaml* const found = task.find("runs");
    if (found == nullptr) return;
    const Yaml runs = *found;
    take_child(task, "runs");
    std::int64_t count = 0;
    std::string wrong = parse_integer(runs.text, 1, 1'000'000, count);
    if (wrong.empty() && whole.count() % count != 0)
      wrong = "is no whole share of the graph's period of " + duration_text(whole);
    if (!wrong.empty()) return problems.add(runs.where, "task '" + task.key + "' key 'runs' " + wrong);
    put_child(task, "period", duration_text(whole / count), runs);
    put_child(task, "let", duration_text(whole / count), runs);
  }

  static void lower(Yaml& graph, Problems& problems) {
    const Yaml* const period = graph.find("timing")->find("period");
    Duration whole{};
    if (period == nullptr || !parse_duration(period->text, whole).empty())
      return problems.add(graph.find("timing")->where,
                          "the grammar 'rates' needs the graph's period, as in 'period: 100ms'");
    if (Yaml* const tasks = find_child(graph, "tasks"); tasks != nullptr)
      for (Yaml& task : tasks->children) lower_task(task, whole, problems);
  }
};
}  // namespace

JAROL_PLUGIN(Rates)

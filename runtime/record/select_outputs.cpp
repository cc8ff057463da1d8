#include "runtime/record/select_outputs.h"

#include <fnmatch.h>

#include <map>
#include <sstream>

#include "graph/language/problems.h"
#include "graph/text/errors.h"

namespace jarol {
namespace {

std::map<std::string, std::pair<Duration, Duration>> timing_of(const Graph& graph) {
  std::map<std::string, std::pair<Duration, Duration>> all;
  for (std::size_t i = 0; i < graph.tasks.size(); ++i)
    for (std::size_t f = 0; f < graph.tasks[i].task_class->out->fields.size(); ++f)
      all[end_name(graph, {End::Kind::task, i, f}, true)] = {
          graph.tasks[i].period,
          (graph.tasks[i].offset + graph.tasks[i].let.value_or(Duration{})) % graph.tasks[i].period};
  for (const Communicator& c : graph.communicators) all[c.name] = {c.period, c.offset};
  return all;
}

}  // namespace

std::vector<SelectedOutput> select_outputs(const Graph& graph, const std::string& what) {
  const auto timing = timing_of(graph);
  std::vector<SelectedOutput> outputs;
  for (const Output& output : outputs_of(graph)) {
    const auto& [period, phase] = timing.at(output.name);
    outputs.push_back({output, period, phase, what == "all"});
  }
  if (what == "all" || what == "inputs") return outputs;
  std::istringstream words(what + ",");
  for (std::string word; std::getline(words, word, ',');) {
    bool fits = false;
    for (SelectedOutput& output : outputs) {
      if (fnmatch(word.c_str(), output.name.c_str(), 0) != 0) continue;
      output.selected = fits = true;
    }
    if (fits) continue;
    std::vector<std::string> names;
    for (const SelectedOutput& output : outputs) names.push_back(output.name);
    throw InputError("--record-what: nothing that is published has the name '" + word + "'" +
                     did_you_mean(word, names) + "; there are: all, inputs, " + list_of(names));
  }
  return outputs;
}

}  // namespace jarol

// Graphs from text, for tests.
#pragma once

#include <string>

#include "graph/analysis/policies.h"
#include "graph/language/load.h"
#include "graph/model/build.h"
#include "tasks/tasks.h"

namespace jarol::tests {

inline const Registry& generic_tasks() {
  static const Registry registry = [] {
    Registry made;
    analysis::add_policies(made);
    tasks::add_tasks(made);
    return made;
  }();
  return registry;
}

/// The graph of a text named t.yaml, of what the registry knows; throws SpecError if it is not valid.
inline Graph graph_of(const Registry& registry, const std::string& text, const Overrides& overrides = {}) {
  Problems problems;
  const auto source = std::make_shared<Source>(Source{"t.yaml", text});
  Graph graph = build_graph(load_spec(source, overrides, problems), registry, problems);
  problems.throw_if_any();
  return graph;
}

/// The same of the tasks that come with Jarol.
inline Graph graph_of(const std::string& text, const Overrides& overrides = {}) {
  return graph_of(generic_tasks(), text, overrides);
}

/// The whole report on a text that is not valid, or nothing.
inline std::string report_on(const Registry& registry, const std::string& text, const Overrides& overrides = {}) {
  try {
    graph_of(registry, text, overrides);
  } catch (const SpecError& error) { return error.what(); }
  return "";
}

inline std::string report_on(const std::string& text, const Overrides& overrides = {}) {
  return report_on(generic_tasks(), text, overrides);
}

}  // namespace jarol::tests

// From the text of a condition or a metric to what it means in a graph.
#pragma once

#include <string>

#include "graph/expect/names.h"

namespace jarol::expect {

/// Reports what is wrong, with its place in the text, and returns nothing then.
std::optional<Condition> parse_condition(const Yaml& text, const Graph& graph, const std::vector<TrueValues>& vehicles,
                                         Problems& problems);

/// What is measured of a run: a metric, whose comparison does not count; with one, a condition; or the instant at which
/// a condition on the value at each instant holds first, "time of VALUE COMPARISON".
struct Measured {
  Condition condition;
  bool is_limit = false;    // it can fail
  bool is_instant = false;  // of Condition::Kind::once
};

/// `key` begins messages.
std::optional<Measured> parse_measured(const Yaml& text, const std::string& key, const Graph& graph,
                                       const std::vector<TrueValues>& vehicles, Problems& problems);

/// A condition on what is published that holds at an instant or does not: VALUE COMPARISON. `key` begins messages.
std::optional<Condition> parse_state(const Yaml& text, const std::string& key, const Graph& graph, Problems& problems);

/// By the key `expect` of a graph no run is judged, by what its mission expects neither.
bool expects_nothing(const Maybe<Yaml>& list);

/// The key `expect` of a graph: a list of conditions, or `nothing`.
std::vector<Condition> read_expectations(const Maybe<Yaml>& list, const Graph& graph,
                                         const std::vector<TrueValues>& vehicles, Problems& problems);

}  // namespace jarol::expect

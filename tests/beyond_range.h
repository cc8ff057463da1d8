// Parameters beyond their range, for tests: each is refused by its path, unit and range.
#pragma once

#include <doctest/doctest.h>

#include <memory>
#include <string>
#include <vector>

#include "graph/values/bind.h"
#include "graph/values/type_of.h"

namespace jarol::tests {

/// A parameter by its path, what it needs, and a value that is something else.
struct Beyond {
  std::vector<std::string> path;
  std::string needs, value;
};

/// Sets it alone. What is wrong, a line each.
template <class Param>
std::string problems_of(const Beyond& beyond) {
  std::string yaml = beyond.value;
  for (auto name = beyond.path.rbegin(); name != beyond.path.rend(); ++name) yaml = "{" + *name + ": " + yaml + "}";
  Param value;
  Problems problems;
  const Yaml read = read_yaml(std::make_shared<Source>(Source{"g.yaml", yaml}), problems);
  bind_fields(read, type_of<Param>(), &value, "task 't'", "parameter", problems);
  std::string all;
  try {
    problems.throw_if_any();
  } catch (const SpecError& error) {
    for (const Problem& problem : error.problems()) all += problem.text + "\n";
  }
  return all;
}

/// Each alone is refused by its full message, and the defaults are not.
template <class Param>
void check_refused(const std::vector<Beyond>& cases) {
  const Param defaults{};
  const auto in_range = type_of<Param>().in_range;
  CHECK((in_range == nullptr || in_range(&defaults)));
  for (const Beyond& c : cases) {
    std::string expected = "task 't' parameter";
    for (const std::string& name : c.path) expected += (&name == &c.path.front() ? " '" : " field '") + name + "'";
    expected += " needs " + c.needs + ", not '" + c.value + "'; that is outside\n";
    CHECK(problems_of<Param>(c) == expected);
  }
}

}  // namespace jarol::tests

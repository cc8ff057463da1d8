// A text read as YAML.
#pragma once

#include <memory>
#include <string>

#include "graph/language/yaml.h"

namespace jarol::tests {

// What is wrong with it; empty: nothing.
inline std::string report_on_yaml(const std::string& text) {
  Problems problems;
  try {
    read_yaml(std::make_shared<Source>(Source{"t.yaml", text}), problems);
    problems.throw_if_any();
  } catch (const SpecError& error) { return error.what(); }
  return "";
}

inline Yaml tree_of(const std::string& text) {
  Problems problems;
  Yaml yaml = read_yaml(std::make_shared<Source>(Source{"t.yaml", text}), problems);
  problems.throw_if_any();
  return yaml;
}

}  // namespace jarol::tests

// Parameters of tasks and distributers, from what a file says.
#pragma once

#include "graph/language/problems.h"
#include "graph/language/yaml.h"
#include "graph/registry.h"
#include "graph/values/value.h"

namespace jarol {

/// Of the task of that name; null: the file says nothing.
Value read_parameters(const std::string& task, const TaskClass& of, const Yaml* yaml, Problems& problems);

/// Of the distributer of that name; without a type where its class has none.
Value read_parameters(const std::string& distributer, const DistributerClass& of, const Yaml* yaml, Problems& problems);

}  // namespace jarol

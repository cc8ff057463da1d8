#include "graph/model/parameters.h"

#include "graph/values/bind.h"

namespace jarol {

Value read_parameters(const std::string& task, const TaskClass& of, const Yaml* yaml, Problems& problems) {
  Value values(*of.parameters);
  if (yaml != nullptr)
    bind_fields(*yaml, *of.parameters, values.data(), "task '" + task + "' (" + of.name + ")", "parameter", problems);
  return values;
}

Value read_parameters(const std::string& distributer, const DistributerClass& of, const Yaml* yaml,
                      Problems& problems) {
  const std::string subject = "distributer '" + distributer + "' (" + of.name + ")";
  if (of.parameters == nullptr) {
    if (yaml != nullptr) problems.add(yaml->where, subject + " has no parameters");
    return {};
  }
  Value values(*of.parameters);
  if (yaml != nullptr) bind_fields(*yaml, *of.parameters, values.data(), subject, "parameter", problems);
  return values;
}

}  // namespace jarol

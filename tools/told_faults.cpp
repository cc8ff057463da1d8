#include "tools/told_faults.h"

#include <nlohmann/json.hpp>

#include "graph/text/escape.h"

namespace jarol::tools {

std::string told_faults(const Report& report) {
  std::string text;
  for (const Fault& fault : report.faults) text += "fault: " + printable(to_text(fault)) + "\n";
  if (report.fault_count > report.faults.size())
    text += "fault: and " + std::to_string(report.fault_count - report.faults.size()) + " more\n";
  return text;
}

nlohmann::ordered_json faults_to_json(const Report& report) {
  auto faults = nlohmann::ordered_json::array();
  for (const Fault& f : report.faults)
    faults.push_back(
        {{"task", f.task}, {"activation", f.activation}, {"instant_ns", f.instant.count()}, {"cause", f.cause}});
  return faults;
}

}  // namespace jarol::tools

#include "tools/bench/yaml_floor.h"

#include <yaml-cpp/yaml.h>

namespace jarol::bench {

double parse_only(const std::string& text) { return static_cast<double>(YAML::Load(text).size()); }

}  // namespace jarol::bench

#include <stdexcept>

#include "graph/plugins/plugin_grammar.h"

namespace {
struct Lost {
  static constexpr std::string_view name = "lost", how = "nobody knows";
  static constexpr jarol::GrammarKey keys[] = {{"tasks", "rate", "none"}};
  static void lower(jarol::Yaml&, jarol::Problems&) { throw std::runtime_error("it has no tasks that it knows"); }
};
}  // namespace

JAROL_PLUGIN(Lost)

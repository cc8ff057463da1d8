#include "graph/plugins/plugin_grammar.h"

namespace {
struct Let {
  static constexpr std::string_view name = "let", how = "otherwise";
  static constexpr jarol::GrammarKey keys[] = {{"tasks", "rate", "none"}};
  static void lower(jarol::Yaml&, jarol::Problems&) {}
};
}  // namespace

JAROL_PLUGIN(Let)

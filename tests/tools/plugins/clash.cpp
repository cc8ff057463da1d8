// A plugin whose task has the name of one that there is.
#include "graph/plugins/plugin.h"

struct Counter {
  static constexpr std::string_view summary = "not the one that you know";
  static void run(const jarol::Tick&) {}
};

JAROL_PLUGIN(Counter)

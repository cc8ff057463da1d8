// This program does not export what it has, and plugins miss it.
#include <doctest/doctest.h>

#include "graph/plugins/plugins.h"
#include "graph/registry.h"

TEST_SUITE("graph/plugins/exports") {
  TEST_CASE("a plugin that finds nothing of jarol in the program says how that is linked") {
    jarol::Registry registry;
    const std::string plugin = JAROL_PLUGIN_FOLDER "/twice.so", wrong = jarol::load_plugin(plugin, registry);
    CAPTURE(wrong);
    CHECK(wrong.starts_with("'" + plugin + "' is no shared library that can be used here: " + plugin +
                            ": undefined symbol: _ZN5jarol"));
    CHECK(
        wrong.ends_with("; the program that loads it must export its symbols: link it with -rdynamic, or set "
                        "ENABLE_EXPORTS in CMake"));
  }
}

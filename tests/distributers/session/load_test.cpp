// What is worth knowing about a graph when it has been loaded.
#include <doctest/doctest.h>

#include <string>

#include "distributers/session/load.h"
#include "graph/language/source_set.h"
#include "tests/distributers/all_parts.h"

namespace {
using namespace jarol;

// A line each, of the submarine's dive; profiles with the vehicle in another process, as no vehicle is built in here.
std::string notes_of(const Overrides& overrides) {
  std::string notes;
  load_graph(read_source("specs/exolauv.yaml"), tests::all_parts_with<>(), overrides, 0,
             [&](const std::string& text) { notes += text + "\n"; });
  return notes;
}
}  // namespace

TEST_SUITE("distributers/session/load") {
  TEST_CASE("instruments that are not fitted are noted as not checked, in the order of the parameters") {
    CHECK(notes_of({"lab", {"distributers.dune.parameters={servos: {fitted: false}, depth: {fitted: false}}"}}) ==
          "distributer 'dune': not fitted, and so not checked: depth, servos\n");
  }

  TEST_CASE("with DUNE they are those that it does not have") {
    for (const char* profile : {"dune", "dune_console"}) {
      CAPTURE(profile);
      CHECK(notes_of({profile, {}}) ==
            "distributer 'dune': not fitted, and so not checked: leak2, leak3, hull_temperature, hull_temperature1, "
            "hull_temperature2, hull_temperature3, voltage, current\n");
    }
  }

  TEST_CASE("where all are fitted nothing is noted, whatever other parameters say") {
    CHECK(notes_of({"lab", {}}) == "");
    CHECK(notes_of({"lab", {"distributers.dune.parameters={gravity: false, voltage: {scale: 0, fitted: true}}"}}) ==
          "");
  }
}

// What commands know where plugins bring more.
#include "tools/commands/run/known_with.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>

#include "distributers/messages/imc.h"
#include "tests/tools/run_command.h"
#include "tools/library/built_in.h"

namespace {
using namespace jarol;
using messages::MessageSet;

std::vector<std::string> names_of(const std::vector<const MessageSet*>& sets) {
  std::vector<std::string> names;
  for (const MessageSet* set : sets) names.emplace_back(set->name);
  return names;
}
}  // namespace

TEST_SUITE("tools/commands/run/known_with") {
  TEST_CASE("message sets are those of the tree, and those that vehicles and distributers of plugins speak") {
    const std::vector<const MessageSet*> of_tree = tools::sets_of(built_in());
    CHECK(std::ranges::equal(of_tree, messages::message_sets()));
    static MessageSet of_lamp = messages::imc::message_set(), of_switch = of_lamp, again = of_lamp;
    of_lamp.name = "lamp";
    of_switch.name = "switch";
    distributers::Registries known = built_in();
    vehicles::VehicleClass lamp;
    lamp.name = "lamp";
    lamp.message_set = &of_lamp;
    known.vehicles.add(lamp);
    vehicles::VehicleClass other;
    other.name = "other";
    other.message_set = &again;  // of a name that is there
    known.vehicles.add(other);
    DistributerClass of_plugin;
    of_plugin.name = "Switch";
    of_plugin.message_set = []() -> const MessageSet& { return of_switch; };
    known.graph.add(of_plugin);
    const std::vector<const MessageSet*> sets = tools::sets_of(known);
    std::vector<std::string> expected = names_of(of_tree);
    expected.insert(expected.end(), {"switch", "lamp"});
    CHECK(names_of(sets) == expected);
    CHECK(std::find(sets.begin(), sets.end(), &again) == sets.end());
  }

  TEST_CASE("commands that list what there is list what a plugin brings, or say why it can't be used") {
    const std::string plugin = std::filesystem::absolute(JAROL_PLUGIN_FOLDER "/world.so");
    CHECK(command::run_jarol("messages --plugin " + plugin).output == command::run_jarol("messages").output);
    CHECK(command::run_jarol("tasks --plugin " + plugin).output.find("\n  LampSwitch") != std::string::npos);
    for (const std::string of : {"messages", "tasks", "vehicle lamp --describe"}) {
      const auto refused = command::run_jarol(of + " --plugin nowhere.so");
      CHECK(refused.output == "error: there is no file 'nowhere.so'\n");
      CHECK(refused.exit_code == 2);
    }
  }
}

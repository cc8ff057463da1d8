// Who at the desks of a run may change its pace.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "distributers/messages/imc.h"
#include "tools/console/desk.h"

namespace {
using namespace jarol;
using nlohmann::json;
using tools::console::Desk;

std::shared_ptr<distributers::ConsolePort> make_port() {
  return std::make_shared<distributers::ConsolePort>(messages::imc::message_set());
}
}  // namespace

TEST_SUITE("console/desk") {
  TEST_CASE("of two pages that command a desk each, neither commands alone") {
    Desk desk{{{"neptus", "LauvOperator", make_port()}, {"neptus2", "LauvOperator", make_port()}}};
    const auto take = [&](std::uint64_t page, const std::string& name) {
      desk.obey(page, json{{"do", "take"}, {"desk", name}, {"as", "me"}, {"sticks", json::object()}}, {});
    };
    CHECK(desk.commanded_by_others(7).empty());
    take(7, "neptus");
    CHECK(desk.commanded_by_others(7).empty());
    CHECK(desk.commanded_by_others(8) == "neptus");
    take(8, "neptus2");
    CHECK(desk.commanded_by_others(7) == "neptus2");
    CHECK(desk.commanded_by_others(8) == "neptus");
    CHECK(desk.commanded_by_others(9) == "neptus");
    // who has both commands alone
    desk.leave(8);
    take(7, "neptus2");
    CHECK(desk.commanded_by_others(7).empty());
  }
}

// jarol messages as people run it.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "distributers/messages/message_set.h"
#include "graph/language/problems.h"
#include "tests/tools/run_command.h"

using command::run_jarol;

TEST_SUITE("tools/messages") {
  TEST_CASE("sets, messages and fields are listed") {
    CHECK(run_jarol("messages").output.find("  javiator  24 messages   JAviator 1: JAviator control protocol\n") !=
          std::string::npos);
    const std::string imc = run_jarol("messages imc").output;
    CHECK(imc.starts_with("imc: Inter Module Communication, IMC 5.4.31\n\n"));
    CHECK(imc.find("\n  401   DesiredZ") != std::string::npos);
    const auto one = run_jarol("messages imc DesiredZ");
    CHECK(one.exit_code == 0);
    CHECK(one.output ==
          "DesiredZ, id 401, 5 bytes: Reference of depth, altitude or height.\n\n"
          "  value    fp32_t [m]            distance\n"
          "  z_units  uint8_t [Enumerated]  what it is measured from\n"
          "                                 0 NONE\n"
          "                                 1 DEPTH\n"
          "                                 2 ALTITUDE\n"
          "                                 3 HEIGHT\n");
  }

  TEST_CASE("the same as JSON") {
    const auto one = nlohmann::json::parse(run_jarol("messages imc DesiredZ --json").output);
    CHECK(one["schema"] == "jarol.messages/2");
    REQUIRE(one["messages"].size() == 1);
    CHECK(one["messages"][0]["name"] == "DesiredZ");
    CHECK(one["messages"][0]["id"] == 401);
    CHECK(one["messages"][0]["fields"][0] ==
          nlohmann::json{{"name", "value"}, {"type", "fp32_t"}, {"unit", "m"}, {"text", "distance"}});
    CHECK(one["messages"][0]["fields"][1]["values"]["DEPTH"] == 1);
    const auto all = nlohmann::json::parse(run_jarol("messages --json").output);
    CHECK(all["messages"].size() > 100);
  }

  TEST_CASE("packets are decoded and encoded from stdin") {
    // the command stands on both sides of the pipes
    const std::string again = " | " + std::string(JAROL_COMMAND) + " messages javiator ";
    const auto decoded = run_jarol("--version > /dev/null; echo ffff11000011" + again + "--decode");
    CHECK(decoded.output.find(R"("name":"SWITCH_STATE")") != std::string::npos);
    const auto there_and_back =
        run_jarol("--version > /dev/null; echo ffff0f021f400070" + again + "--decode" + again + "--encode");
    CHECK(there_and_back.output == "ffff0f021f400070\n");
  }

  TEST_CASE("what is not there is said") {
    const auto error = [](const std::string& arguments) {
      const auto result = run_jarol("messages " + arguments);
      CHECK(result.exit_code == 2);
      return result.output;
    };
    std::vector<std::string> sets;
    for (const auto* const set : jarol::messages::message_sets()) sets.emplace_back(set->name);
    CHECK(error("imd") ==
          "error: there is no message set 'imd'; did you mean 'imc'?; there are: " + jarol::list_of(sets) + "\n");
    CHECK(error("imc DesiredY") == "error: set imc has no message 'DesiredY'; did you mean 'DesiredZ'?\n");
    CHECK(error("imc Qqqqqqq") == "error: set imc has no message 'Qqqqqqq'; jarol messages imc lists them\n");
    CHECK(error("--decode") == "error: --decode and --encode need a set; jarol messages lists them\n");
    CHECK(error("imc --decode --encode").find("excludes") != std::string::npos);
  }
}

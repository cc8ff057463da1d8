// What a page sent that no longer commands, and that a paused or slow run has not taken yet.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "distributers/messages/javiator.h"
#include "tools/console/desk.h"

namespace {
using namespace jarol;
using nlohmann::json;
using tools::console::Desk;
namespace javiator = messages::javiator;

struct Terminal {
  std::shared_ptr<distributers::ConsolePort> port =
      std::make_shared<distributers::ConsolePort>(javiator::message_set());
  Desk desk{{{"terminal", "JaviatorOperator", port}}};
  Desk::Clock::time_point now{};

  void take(std::uint64_t page) {
    desk.obey(page, json{{"do", "take"}, {"desk", "terminal"}, {"as", "me"}, {"sticks", json::object()}}, now);
  }
  void send(std::uint64_t page, std::uint64_t sequence, const std::string& message, const json& fields) {
    const json all{
        {"do", "send"}, {"desk", "terminal"}, {"message", message}, {"sequence", sequence}, {"fields", fields}};
    desk.obey(page, all, now);
  }
  // what the run gets, in words
  std::string taken() {
    struct Words : messages::Receiver {
      void receive(messages::MessageRef message) override {
        text += std::string(message.descriptor->name);
        if (const auto* command = message.as<javiator::CommandData>()) text += " " + std::to_string(command->roll);
        text += "; ";
      }
      std::string text;
    } words;
    port->receive(words);
    return words.text;
  }
};
}  // namespace

TEST_SUITE("console/desk") {
  TEST_CASE("what a page sent is not obeyed after it has gone, but for emergencies") {
    Terminal at;
    at.take(7);
    at.send(7, 1, "COMMAND_DATA", {{"roll", 10}});
    CHECK(at.taken() == "COMMAND_DATA 10; ");
    at.send(7, 2, "COMMAND_DATA", {{"roll", 20}});
    at.send(7, 3, "SHUT_DOWN", json::object());
    SUBCASE("it left") { at.desk.leave(7); }
    SUBCASE("it let go") { at.desk.obey(7, json{{"do", "release"}, {"desk", "terminal"}}, at.now); }
    SUBCASE("it fell silent") {
      at.now += Desk::patience + std::chrono::milliseconds(1);
      at.desk.news(at.now);
    }
    CHECK(at.taken() == "SHUT_DOWN; ");
    CHECK(at.port->left_out() == 1);
  }

  TEST_CASE("a page that takes command is obeyed, and not the one before it, whatever that one had sent") {
    Terminal at;
    at.take(7);
    at.send(7, 1, "COMMAND_DATA", {{"roll", 20}});
    at.desk.leave(7);
    at.take(8);
    at.send(8, 1, "COMMAND_DATA", {{"roll", -30}});
    CHECK(at.taken() == "COMMAND_DATA -30; ");
    CHECK(at.port->left_out() == 1);
  }
}

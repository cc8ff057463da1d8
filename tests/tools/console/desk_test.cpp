// Who steers at the pages of a console, and how a page loses that.
#include "tools/console/desk.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "distributers/messages/imc.h"
#include "distributers/messages/javiator.h"
#include "graph/text/errors.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;
using nlohmann::json;
using tools::console::Desk;
namespace javiator = messages::javiator;

// A desk of one operator, whose clock the test sets.
struct Desks {
  std::shared_ptr<distributers::ConsolePort> port =
      std::make_shared<distributers::ConsolePort>(javiator::message_set());
  Desk desk{{{"terminal", "JaviatorOperator", port}}};
  Desk::Clock::time_point now{};

  void ask(std::uint64_t page, const std::string& message) { desk.obey(page, json::parse(message), now); }
  void take(std::uint64_t page) {
    ask(page, R"({"do": "take", "desk": "terminal", "as": "me", "sticks": {"roll": 0}})");
  }
  void send(std::uint64_t page, int sequence, int roll) {
    ask(page, R"({"do": "send", "desk": "terminal", "message": "COMMAND_DATA", "sequence": )" +
                  std::to_string(sequence) + R"(, "fields": {"roll": )" + std::to_string(roll) + "}}");
  }
  // who commands
  json commander() { return desk.news(now)["terminal"]["commander"]; }
  // the rolls that the run gets
  std::vector<int> taken() {
    struct Rolls : messages::Receiver {
      void receive(messages::MessageRef message) override {
        if (const auto* command = message.as<javiator::CommandData>()) all.push_back(command->roll);
      }
      std::vector<int> all;
    } rolls;
    port->receive(rolls);
    return rolls.all;
  }
};
}  // namespace

TEST_SUITE("console/desk") {
  TEST_CASE("pages learn which operators are at the console") {
    Desks desks;
    CHECK(json(desks.desk.describe()) ==
          json::parse(R"([{"name": "terminal", "type": "JaviatorOperator", "messages": "javiator"}])"));
    CHECK(desks.desk.news(desks.now).is_null());
  }

  TEST_CASE("who takes command steers, and the run gets its messages in their order") {
    Desks desks;
    desks.take(7);
    CHECK(desks.commander() == "me");
    CHECK(desks.desk.news(desks.now).is_null());
    desks.send(7, 1, 10);
    desks.send(7, 2, 20);
    CHECK(desks.taken() == std::vector<int>{10, 20});
  }

  TEST_CASE("a message that is no newer than another was held up, and is not taken") {
    Desks desks;
    desks.take(7);
    desks.send(7, 5, 10);
    desks.send(7, 5, 20);
    desks.send(7, 4, 30);
    desks.send(7, 6, 40);
    CHECK(desks.taken() == std::vector<int>{10, 40});
  }

  TEST_CASE("who does not command sends nothing") {
    Desks desks;
    CHECK_THROWS_WITH_AS(desks.send(7, 1, 10), "this page does not command 'terminal'; take it first", InputError);
    desks.take(7);
    CHECK_THROWS_WITH_AS(desks.send(8, 1, 10), "this page does not command 'terminal'; take it first", InputError);
    CHECK(desks.taken().empty());
  }

  TEST_CASE("a stick that is not centred does not take over") {
    Desks desks;
    CHECK_THROWS_WITH_AS(
        desks.ask(7, R"({"do": "take", "desk": "terminal", "as": "me", "sticks": {"roll": 0.04, "pitch": -0.4}})"),
        "stick 'pitch' is at -0.4; centre it to take over", InputError);
    CHECK_THROWS_WITH_AS(desks.ask(7, R"({"do": "take", "desk": "terminal", "as": "me"})"),
                         "expected the sticks' places as \"sticks\", as in {\"roll\": 0}", InputError);
    CHECK(desks.desk.news(desks.now).is_null());
  }

  TEST_CASE("a second page takes command only once the first has let go, has gone, or is silent") {
    Desks desks;
    desks.take(7);
    CHECK_THROWS_WITH_AS(desks.take(8), "another page commands 'terminal'; it has to release it, or to fall silent",
                         InputError);
    SUBCASE("it lets go") { desks.ask(7, R"({"do": "release", "desk": "terminal"})"); }
    SUBCASE("it lets go of what it has lost, too") {
      desks.ask(7, R"({"do": "release", "desk": "terminal"})");
      CHECK_NOTHROW(desks.ask(7, R"({"do": "release", "desk": "terminal"})"));
    }
    SUBCASE("it is gone") { desks.desk.leave(7); }
    SUBCASE("it is silent") {
      desks.now += Desk::patience + 1ms;
      desks.desk.news(desks.now);
    }
    CHECK_NOTHROW(desks.take(8));
    CHECK_NOTHROW(desks.send(8, 1, 10));
    CHECK_THROWS_AS(desks.send(7, 9, 10), InputError);
  }

  TEST_CASE("all pages learn why nobody commands any more") {
    Desks desks;
    desks.take(7);
    desks.desk.news(desks.now);
    std::string why;
    SUBCASE("released") {
      desks.ask(7, R"({"do": "release", "desk": "terminal"})");
      why = "it was released";
    }
    SUBCASE("gone") {
      desks.desk.leave(7);
      why = "the page that commanded is gone";
    }
    SUBCASE("silent") {
      desks.now += Desk::patience;
      CHECK(desks.desk.news(desks.now).is_null());
      desks.now += 1ms;
      why = "the page that commanded was silent";
    }
    CHECK(json(desks.desk.news(desks.now)) == json{{"terminal", {{"commander", nullptr}, {"why", why}}}});
  }

  TEST_CASE("who commands is said again every two seconds, for pages that missed it") {
    Desks desks;
    desks.take(7);
    const json commands = json(desks.desk.news(desks.now));
    CHECK(commands == json{{"terminal", {{"commander", "me"}}}});
    for (int i = 0; i < 3; ++i) {
      desks.now += Desk::patience;
      desks.ask(7, R"({"do": "alive", "desk": "terminal"})");
      CHECK(desks.desk.news(desks.now).is_null());
      desks.now += Desk::patience;
      desks.ask(7, R"({"do": "alive", "desk": "terminal"})");
      CHECK(json(desks.desk.news(desks.now)) == commands);
    }
    desks.desk.leave(7);
    const json nobody = json(desks.desk.news(desks.now));
    CHECK(nobody == json{{"terminal", {{"commander", nullptr}, {"why", "the page that commanded is gone"}}}});
    desks.now += Desk::repeat;
    CHECK(json(desks.desk.news(desks.now)) == nobody);
    CHECK(Desk({}).news(desks.now).is_null());
  }

  TEST_CASE("who is heard, with a command or without, goes on commanding") {
    Desks desks;
    desks.take(7);
    for (int i = 1; i < 10; ++i) {
      desks.now += Desk::patience;
      if (i % 2 == 0)
        desks.send(7, i, 0);
      else
        desks.ask(7, R"({"do": "alive", "desk": "terminal"})");
      desks.desk.news(desks.now);
    }
    CHECK_NOTHROW(desks.send(7, 100, 0));
  }

  TEST_CASE("who looks at what is old does not command, and all learn why") {
    Desks desks;
    desks.take(7);
    desks.desk.news(desks.now);
    const Duration old = Desk::max_behind + 400ms;
    const auto ask = [&](const std::string& message, Duration behind) {
      desks.desk.obey(7, json::parse(message), desks.now, behind);
    };
    const std::string lean =
        R"({"do": "send", "desk": "terminal", "message": "COMMAND_DATA", "sequence": 1, "fields": {"roll": 9}})";
    ask(lean, Desk::max_behind);
    CHECK(desks.taken() == std::vector<int>{9});
    CHECK_THROWS_WITH_AS(ask(lean, old), "what this page shows is 3.4 s old: 'COMMAND_DATA' is not sent", InputError);
    CHECK(desks.taken().empty());
    // nor is it heard
    desks.now += Desk::patience;
    CHECK_NOTHROW(ask(R"({"do": "alive", "desk": "terminal"})", old));
    desks.now += 1ms;
    CHECK(json(desks.desk.news(desks.now)) ==
          json{{"terminal", {{"commander", nullptr}, {"why", "what the page that commanded shows is 3.4 s old"}}}});
    const std::string take = R"({"do": "take", "desk": "terminal", "as": "me", "sticks": {"roll": 0}})";
    CHECK_THROWS_WITH_AS(ask(take, old), "what this page shows is 3.4 s old: it can't take over", InputError);
    CHECK_NOTHROW(ask(take, 0ms));
    CHECK(desks.commander() == "me");
    // who is silent after that was silent
    desks.now += Desk::patience + 1ms;
    CHECK(desks.desk.news(desks.now)["terminal"]["why"] == "the page that commanded was silent");
  }

  TEST_CASE("what ends all is obeyed however old that is which the page shows") {
    const auto port = std::make_shared<distributers::ConsolePort>(messages::imc::message_set());
    Desk desk{{{"neptus", "LauvOperator", port}}};
    const Desk::Clock::time_point now{};
    const auto ask = [&](const std::string& message, Duration behind) {
      desk.obey(7, json::parse(message), now, behind);
    };
    ask(R"({"do": "take", "desk": "neptus", "as": "me", "sticks": {}})", 0ms);
    ask(R"({"do": "send", "desk": "neptus", "message": "Abort", "sequence": 1})", 30s);
    struct Aborts : messages::Receiver {
      void receive(messages::MessageRef message) override { all.emplace_back(message.descriptor->name); }
      std::vector<std::string> all;
    } aborts;
    port->receive(aborts);
    CHECK(aborts.all == std::vector<std::string>{"Abort"});
    aborts.all.clear();
    // another page does not abort what this one commands, and does where nobody commands
    const auto abort_of_another = [&] {
      desk.obey(8, json::parse(R"({"do": "send", "desk": "neptus", "message": "Abort", "sequence": 1})"), now, 30s);
    };
    CHECK_THROWS_WITH_AS(abort_of_another(), "this page does not command 'neptus'; take it first", InputError);
    ask(R"({"do": "release", "desk": "neptus"})", 30s);
    CHECK(json(desk.news(now))["neptus"]["why"] == "it was released");
    port->receive(aborts);
    CHECK(aborts.all.empty());
    CHECK_NOTHROW(abort_of_another());
    port->receive(aborts);
    CHECK(aborts.all == std::vector<std::string>{"Abort"});
    CHECK(json(desk.news(now)).is_null());  // nor does that page command now
    // a desk of the helicopter
    Desks desks;
    desks.take(7);
    CHECK_NOTHROW(
        desks.desk.obey(7, json::parse(R"({"do": "send", "desk": "terminal", "message": "SHUT_DOWN", "sequence": 1})"),
                        desks.now, 30s));
  }

  TEST_CASE("what an operator's distributer says reaches the pages once, in its words") {
    const auto port = std::make_shared<distributers::ConsolePort>(messages::imc::message_set());
    Desk desk{{{"neptus", "LauvOperator", port}}};
    CHECK(desk.answers().is_null());
    messages::imc::VehicleCommand answer;
    answer.type = messages::imc::VehicleCommand::Type::FAILURE;
    answer.request_id = 7;
    answer.info = "just aborted";
    port->answer(messages::refer_to(messages::imc::Heartbeat{}));
    port->answer(messages::refer_to(answer));
    const json answers = desk.answers()["neptus"];
    REQUIRE(answers.size() == 2);
    CHECK(answers[0] == json::parse(R"({"message": "Heartbeat", "fields": {}})"));
    CHECK(answers[1]["message"] == "VehicleCommand");
    CHECK(answers[1]["fields"]["type"] == messages::imc::VehicleCommand::Type::FAILURE);
    CHECK(answers[1]["fields"]["request_id"] == 7);
    CHECK(answers[1]["fields"]["info"] == "just aborted");
    CHECK(answers[1]["fields"]["maneuver"] == nullptr);
    CHECK(desk.answers().is_null());
  }

  TEST_CASE("what makes no sense is said") {
    Desks desks;
    desks.take(7);
    const auto refused = [&](const std::string& message, const char* why) {
      CHECK_THROWS_WITH_AS(desks.ask(7, message), why, InputError);
    };
    refused(R"({"do": "take", "desk": "neptus"})", "there is no desk of 'neptus'; there are: terminal");
    refused(R"({"do": "take", "desk": ")" + std::string(5000, 'x') + R"("})",
            ("there is no desk of '" + std::string(60, 'x') + "...'; there are: terminal").c_str());
    refused(R"({"do": "take", "desk": 1})", "expected a text as \"desk\"");
    refused(R"({"do": "fly", "desk": "terminal"})",
            "there is no 'fly' to do at a desk; there are: alive, release, send, take");
    refused(R"({"do": "send", "desk": "terminal", "message": "FLY", "sequence": 1})", "javiator has no message 'FLY'");
    refused(R"({"do": "send", "desk": "terminal", "message": "FLY"})", "expected a number that grows as \"sequence\"");
    refused(R"({"do": "send", "desk": "terminal", "message": "SHUT_DOWN", "sequence": -1})",
            "expected a number that grows as \"sequence\"");
    CHECK_THROWS_WITH_AS(desks.send(7, 1, 1'000'000), doctest::Contains("COMMAND_DATA: "), InputError);
    CHECK(desks.taken().empty());
  }

  TEST_CASE("what a run that is halted does not take is not kept for ever, and is said to be lost") {
    Desks desks;
    desks.take(7);
    constexpr int max = distributers::ConsolePort::max_packets;
    for (int i = 1; i <= max; ++i) desks.send(7, i, i);
    CHECK_THROWS_WITH_AS(desks.send(7, max + 1, 0), "COMMAND_DATA is lost: the run has not taken what was sent before",
                         InputError);
    CHECK(desks.taken().size() == max);
    CHECK(desks.port->refused() == 1);
    CHECK_NOTHROW(desks.send(7, max + 1, 0));
  }
}

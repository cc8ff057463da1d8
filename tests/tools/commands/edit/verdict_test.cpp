// What loader and check say of a text, and where what it says is drawn.
#include "tools/commands/edit/verdict.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "tests/tools/run_command.h"
#include "tools/commands/edit/catalogue.h"
#include "tools/commands/edit/spec_drawing.h"
#include "tools/drawing/graph/drawing_json.h"
#include "tools/library/built_in.h"

namespace {
using namespace jarol;
using Json = nlohmann::ordered_json;
using tools::edit::draw;
using tools::edit::EditedText;
using tools::edit::judge;
using tools::edit::suggest;

EditedText text_of(const std::string& text, const std::string& profile = "") {
  return {std::make_shared<Source>(Source{"specs/edited.yaml", text}), {profile, {}}};
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  REQUIRE(at != std::string::npos);
  return text.replace(at, what.size(), by);
}

const Json* node(const Json& drawn, const std::string& name) {
  for (const Json& each : drawn["drawing"]["nodes"])
    if (each["name"] == name) return &each;
  return nullptr;
}
}  // namespace

TEST_SUITE("editor/verdict") {
  TEST_CASE("a text that is right has the verdict of check") {
    const Json verdict = judge(text_of(command::content("specs/counting.yaml")));
    CHECK(verdict["problems"] == Json::array());
    CHECK(verdict["check"]["verdict"] == "schedulable");
    CHECK(verdict["check"]["tasks"].size() == 5);
    CHECK(verdict["report"].get<std::string>().find("SCHEDULABLE") != std::string::npos);
  }

  TEST_CASE("of a text that is wrong all problems are reported, each with its place") {
    const std::string text = command::content("specs/counting.yaml");
    const Json verdict =
        judge(text_of(replaced(replaced(text, "type: Sum,", "type: Som,"), "total: {type", "total: {typ")));
    CHECK_FALSE(verdict.contains("check"));
    const Json& problems = verdict["problems"];
    REQUIRE(problems.size() == 3);
    CHECK(problems[0]["file"] == "specs/edited.yaml");
    CHECK(problems[0]["line"] == 7);
    CHECK(problems[0]["text"] ==
          "communicator 'total' has no channel; add 'channel: distributer.channel', or both 'type' and 'direction'");
    CHECK(problems[1]["column"] == 11);
    CHECK(problems[2]["line"] == 12);
    CHECK(judge(text_of("tasks: [\n"))["problems"][0]["line"] == 2);
    CHECK(judge(text_of(""))["problems"].size() == 1);
  }

  TEST_CASE("a profile is judged as it is run") {
    const std::string text =
        "graph: a\ntasks:\n  a: {type: Work, period: 4ms, wcet: 2ms}\nprofiles:\n  slow: {tasks.a.wcet: 5ms}\n";
    CHECK(judge(text_of(text))["check"]["verdict"] == "schedulable");
    CHECK(judge(text_of(text, "slow"))["check"]["verdict"] == "not_schedulable");
  }

  TEST_CASE("what is suggested, set in the text, is schedulable") {
    const std::string late = replaced(command::content("specs/counting.yaml"), "wcet: 2ms", "wcet: 16ms");
    CHECK(judge(text_of(late))["check"]["verdict"] == "not_schedulable");
    const Json list = suggest(text_of(late));
    REQUIRE(list.size() > 0);
    for (const Json& suggestion : list) {
      EditedText changed = text_of(late);
      for (const Json& set : suggestion["set"]) changed.overrides.set.push_back(set);
      CAPTURE(suggestion["text"]);
      CHECK(judge(changed)["check"]["verdict"] == "schedulable");
    }
    CHECK(suggest(text_of("tasks: [")) == Json::array());
  }

  TEST_CASE("plugins that the saved file does not name are not loaded") {
    const Source text{"specs/edited.yaml", "graph: a\nplugins: [one.so, two.so]\n"};
    CHECK(tools::edit::refused_plugins(text, {"two.so", "one.so"}) == "");
    CHECK(tools::edit::refused_plugins(text, {"one.so"}) ==
          "the editor loads those that the file names; save it, and start jarol edit again");
    CHECK(tools::edit::plugins_of(std::make_shared<Source>(text)) == std::vector<std::string>{"one.so", "two.so"});
  }

  TEST_CASE("a text that is right is drawn as jarol graph --svg draws it") {
    for (const char* file : {"specs/counting.yaml", "specs/exolauv.yaml", "specs/exolauv_bare.yaml",
                             "specs/javiator.yaml", "specs/window.yaml", "specs/passthrough.yaml"}) {
      CAPTURE(file);
      const Loaded loaded = tools::load_without_systems(file, {});
      Json of_graph = to_json(tools::lay_out(*loaded.graph));
      Json of_text = draw(EditedText{read_source(file), {}})["drawing"];
      // the places of connections are those in the text, or those in the graph
      for (Json* drawing : {&of_graph, &of_text})
        for (Json& arrow : (*drawing)["arrows"]) arrow["connections"] = arrow["connections"].size();
      CHECK(of_text == of_graph);
    }
  }

  TEST_CASE("what is not right yet is drawn, too") {
    const Json drawn = draw(text_of(R"(graph: a
communicators: {seen: {channel: none.there}, reported: {type: double}}
distributers: {dune: {type: LauvVehicle}, other: {}}
tasks: {one: {type: Nothing, period: 5ms}, two: {period: 5ms, let: 2ms}}
connections: [one.a -> two.b, one.c -> two.d, one -> nowhere, two.x -> reported, rubbish]
)"));
    REQUIRE(node(drawn, "one") != nullptr);
    CHECK((*node(drawn, "one"))["lines"] == Json::array({"Nothing", "every 5ms"}));
    CHECK((*node(drawn, "two"))["lines"] == Json::array({"no type", "every 5ms", "LET 2ms"}));
    CHECK((*node(drawn, "seen"))["kind"] == "in");
    CHECK((*node(drawn, "reported"))["kind"] == "out");
    CHECK((*node(drawn, "reported"))["lines"] == Json::array({"no period"}));
    CHECK((*node(drawn, "other"))["lines"] == Json::array({"no type"}));
    CHECK(drawn["drawing"]["nodes"].size() == 6);
    REQUIRE(drawn["drawing"]["arrows"].size() == 2);
    CHECK(drawn["drawing"]["arrows"][0]["connections"] == Json::array({0, 1}));
    CHECK(drawn["drawing"]["arrows"][0]["text"] == "one.a -> two.b\none.c -> two.d");
    CHECK(drawn["drawing"]["arrows"][1]["connections"] == Json::array({3}));
    CHECK(drawn["connections"].size() == 4);
    CHECK(drawn["connections"][2] == Json({{"from", "one"}, {"to", "nowhere"}}));
  }

  TEST_CASE("nothing, and what is no YAML, is drawn as nothing") {
    for (const char* text :
         {"", "graph: a\n", "tasks: [", "- a\n", "graph: a\ndistributers: {d: {type: LauvVehicle}}\n"}) {
      CAPTURE(text);
      CHECK(draw(text_of(text))["drawing"]["arrows"] == Json::array());
    }
  }

  TEST_CASE("a graph that nobody could look at is not drawn") {
    std::string text = "graph: a\ntasks:\n";
    for (int i = 0; i < 401; ++i) text += "  t" + std::to_string(i) + ": {type: Work, period: 5ms}\n";
    const Json drawn = draw(text_of(text));
    CHECK(drawn["why"] == "a graph of 401 parts is not drawn; up to 400 are");
    CHECK_FALSE(drawn.contains("drawing"));
  }

  TEST_CASE("forms have every parameter with its unit, range, default and meaning") {
    const Json catalogue = tools::edit::catalogue_of(built_in());
    const auto named = [](const Json& list, const std::string& name, const char* key = "name") {
      for (const Json& each : list)
        if (each[key] == name) return each;
      return Json();
    };
    const Json depth = named(catalogue["tasks"], "DepthControl");
    CHECK(depth["inputs"][0]["name"] == "motion");
    CHECK(depth["outputs"][0] == Json({{"name", "moment"}, {"type", "Moment"}, {"text", depth["outputs"][0]["text"]}}));
    const Json kp = named(depth["parameters"], "kp", "path");
    CHECK(kp["kind"] == "number");
    CHECK(kp["default"].is_string());
    const Json lauv = named(catalogue["distributers"], "LauvVehicle");
    CHECK(named(lauv["channels"], "actuation")["direction"] == "out");
    CHECK(named(lauv["parameters"], "depth.entity", "path")["kind"] == "text");
    CHECK(named(catalogue["keys"]["tasks"], "on_fault")["choices"] == Json::array({"stop", "hold", "skip", "restart"}));
    CHECK(named(catalogue["links"], "udp")["keys"].size() > 3);
    CHECK(named(catalogue["keys"]["tasks"], "type")["required"] == true);
  }
}

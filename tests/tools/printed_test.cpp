// What the command prints of names, paths and texts that others chose; and its JSON, whatever they hold.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "graph/text/escape.h"
#include "tests/tools/run_command.h"
#include "tools/report/printable_stream.h"

namespace {
command::Result run_command(const std::string& arguments, const std::string& errors = "2>&1") {
  return command::run_jarol(arguments, errors);
}
using command::content;
using command::TemporaryFolder;

// No byte of it is more to a terminal than a character to show, and it is UTF-8.
bool is_harmless(const std::string& text) { return jarol::printable_lines(text) == text; }

bool is_xml(const std::string& path) {
  return std::system(("python3 -c 'import sys, xml.dom.minidom as m; m.parse(sys.argv[1])' " + path + " 2>/dev/null")
                         .c_str()) == 0;
}

// In double quotes of YAML: escapes of a terminal, a C1, a right-to-left override, an end of the line.
const std::string nasty = R"("a & <b>\e[31m \"q\\ \x9b \u202e \n x")";

std::string graph_named(const std::string& name) {
  return "graph: " + name + R"(
communicators: {o: {type: double, direction: out, period: 10ms}}
tasks:
  fast: {type: Counter, period: 10ms, wcet: 6ms}
  slow: {type: Accumulate, period: 20ms, wcet: 3ms}
connections: [fast.out -> slow.in, slow.out -> o]
)";
}
}  // namespace

TEST_SUITE("tools/printed") {
  TEST_CASE("what goes through a stream is shown, in whatever pieces it comes") {
    const std::string text = "a\x1b[2J\xc2\x9b\xe2\x80\xae\xf0\x9f\x9a\x81 \xff\n\tend";
    for (std::size_t piece = 1; piece <= text.size(); ++piece) {
      std::ostringstream out;
      {
        const jarol::tools::PrintableStream printable(out);
        for (std::size_t at = 0; at < text.size(); at += piece) out << text.substr(at, piece) << std::flush;
      }
      CHECK(out.str() == "a\\x1b[2J\\u009b\\u202e\U0001f681 \\xff\n\tend");
    }
    std::ostringstream cut;
    {
      const jarol::tools::PrintableStream printable(cut);
      cut << 'a' << 3 << "\xe2\x80";
    }
    CHECK(cut.str() == "a3\\xe2\\x80");
  }

  TEST_CASE("a graph of any name is checked, run, drawn and replayed, and no terminal obeys it") {
    const TemporaryFolder folder;
    const std::string file = folder.write("g.yaml", graph_named(nasty));
    const std::string log = folder / "log", plot = folder / "p.svg", gantt = folder / "g.svg";
    const std::string shown = R"(a & <b>\x1b[31m "q\ \u009b \u202e \n x)";
    const auto prints = [&](const std::string& arguments) {
      CAPTURE(arguments);
      const auto result = run_command(arguments);
      CHECK(is_harmless(result.output));
      return result.output;
    };
    CHECK(prints("run " + file + " --for 1s --log " + log + " --plot " + plot).find("\n" + shown + ": 1 s on the ") !=
          std::string::npos);
    CHECK(prints("replay " + log).starts_with(shown + ": replay of 1 s in "));
    CHECK(prints("graph " + file).starts_with("graph " + shown + "\n"));
    CHECK(prints("graph --dot " + file)
              .starts_with("digraph \"a & <b>\\\\x1b[31m \\\"q\\\\ \\\\u009b \\\\u202e \\\\n x\" {\n"));
    CHECK(prints("check " + file + " --set tasks.slow.wcet=13ms --svg " + gantt).starts_with(file + ": NOT SCHED"));
    CHECK(is_xml(plot));
    CHECK(content(plot).find("<title>a &amp; &lt;b&gt;\\x1b[31m") != std::string::npos);
    CHECK(is_xml(gantt));
    CHECK(content(gantt).find(">a &amp; &lt;b&gt;\\x1b[31m") != std::string::npos);
    for (const std::string command : {"run --for 1s --json ", "graph --json ", "check --json "}) {
      const auto result = run_command(command + file, "2>/dev/null");
      CHECK(result.exit_code == 0);
      CHECK(std::all_of(result.output.begin(), result.output.end(),
                        [](char c) { return c == '\n' || (c >= ' ' && c < 0x7f); }));
      CHECK(nlohmann::json::parse(result.output)["graph"] == "a & <b>\x1b[31m \"q\\ \u009b \u202e \n x");
    }
  }

  TEST_CASE("what is wrong is shown as one line a problem, whatever was written") {
    const TemporaryFolder folder;
    const std::string file =
        folder.write("g.yaml", "graph: g\ntasks: {\"a\\e]0;t\\a\\nb\": {type: \"\\x9b\xe2\x80\xae\"}}\n");
    const auto wrong = run_command("graph " + file);
    CHECK(wrong.exit_code == 2);
    CHECK(is_harmless(wrong.output));
    CHECK(wrong.output.starts_with(
        file + R"(:2:9: error: task name 'a\x1b]0;t\x07\nb' is not a name; use letters, digits and _, no digit first)"
               "\n"));
    CHECK(wrong.output.find(R"(\u009b\u202e)") != std::string::npos);
    // the line that is shown has a dot for each character that is not
    CHECK(wrong.output.find("{type: \"\\x9b.\"}}\n") != std::string::npos);
    const std::string odd = folder.write("\x1b[7mno\n\xff.yaml", "graph: [\n");
    const auto path = run_command("graph '" + odd + "'");
    CHECK(is_harmless(path.output));
    CHECK(path.output.find(R"(/\x1b[7mno\n\xff.yaml:2:1: error: )") != std::string::npos);
    CHECK(is_harmless(run_command("graph $'\\e[7m' --profil").output));
    CHECK(is_harmless(run_command("$'\\e[7m'").output));
  }

  TEST_CASE("with --json what is wrong is an object, on every command that has it") {
    const TemporaryFolder folder;
    const std::string bad = folder.write("bad.yaml", "graph: g\ntasks: {a: {type: Counter, period: 1}, a: {}}\n");
    const auto problems_of = [](const std::string& arguments, int exit_code = 2) {
      CAPTURE(arguments);
      const auto result = run_command(arguments, "2>/dev/null");
      CHECK(result.exit_code == exit_code);
      const auto json = nlohmann::json::parse(result.output, nullptr, false);
      REQUIRE(json.is_object());
      CHECK(json["schema"] == "jarol.problems/1");
      REQUIRE(!json["problems"].empty());
      return json["problems"];
    };
    for (const std::string command : {"run --for 1s ", "check ", "graph "}) {
      const auto problems = problems_of(command + "--json " + bad);
      REQUIRE(problems.size() == 2);
      CHECK(problems[0]["file"] == bad);
      CHECK(problems[0]["line"] == 2);
      CHECK(problems[0]["column"] == 36);
      CHECK(problems[0]["text"] ==
            "task 'a' key 'period': '1' has no unit; write one of h, min, s, ms, us or ns, as in 10ms");
      CHECK(problems[0]["notes"].empty());
      CHECK(problems[1]["text"] == "key 'a' appears twice in one mapping; keep one");
      REQUIRE(problems[1]["notes"].size() == 1);
      CHECK(problems[1]["notes"][0] ==
            nlohmann::json{{"file", bad}, {"line", 2}, {"column", 9}, {"text", "first here"}});
    }
    const std::string odd = folder.write("no\xff.yaml", "graph: [\n");
    CHECK(std::string(problems_of("graph --json '" + odd + "'")[0]["file"]).ends_with("/no\ufffd.yaml"));
    const auto text_of = [&](const std::string& arguments, int exit_code = 2) {
      const auto problems = problems_of(arguments, exit_code);
      CHECK(problems.size() == 1);
      CHECK(problems[0]["file"].is_null());
      CHECK(problems[0]["line"].is_null());
      return std::string(problems[0]["text"]);
    };
    CHECK(text_of("replay --json no.log") == "can't read 'no.log': No such file or directory");
    CHECK(text_of("nonsense --json").starts_with("there is no command 'nonsense'; there are: bench, "));
    for (const std::string command : {"run ", "check ", "graph "})
      CHECK(problems_of(command + "--json no.yaml")[0] ==
            nlohmann::json{{"file", "no.yaml"},
                           {"line", nullptr},
                           {"column", nullptr},
                           {"text", "can't read 'no.yaml': No such file or directory"},
                           {"notes", nlohmann::json::array()}});
    CHECK(text_of("run --json") == "run: FILE is required");
    CHECK(text_of("run --json specs/counting.yaml --for 3") ==
          "--for: '3' has no unit; write one of h, min, s, ms, us or ns, as in 10ms");
    CHECK(text_of("run specs/counting.yaml --for 1s --jso --json").starts_with("run has no option '--jso'; did you"));
    CHECK(text_of("check --json") == "check needs a FILE, a graph");
    CHECK(text_of("messages --json nonsense").starts_with("there is no message set 'nonsense'"));
    CHECK(text_of("tasks --json Nonsense")
              .starts_with("there is no task, distributer, vehicle, link, policy or grammar 'Nonsense'"));
    CHECK(text_of("vehicle --json").find("NAME") != std::string::npos);
    CHECK(text_of("doctor --json --for 1us") == "--for: '1us' is less than one period of 1ms");
    CHECK(text_of("bench --json nonsense").starts_with("there is no figure 'nonsense'"));
    CHECK(text_of("run --clock real --for 1s --json specs/counting.yaml --set tasks.slow.wcet=99ms", 1)
              .starts_with("'specs/counting.yaml' is not schedulable: "));
    // where it is another option's value it is none
    CHECK(run_command("graph no.yaml --set --json", "2>/dev/null").output == "");
  }
}

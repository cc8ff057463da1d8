// Elements, attributes and texts of SVG, and pictures of a graph whose name is full of markup.
#include "tools/drawing/svg.h"

#include <doctest/doctest.h>

#include "tests/tools/run_command.h"

namespace {
using namespace jarol;
using tools::fixed, tools::px, tools::Svg;

// What a browser would refuse, or find where a name stands: nothing, if names stay names.
std::string markup_of_names(const std::string& svg) {
  if (svg.find("<svg ") == std::string::npos) return "no picture: " + svg;
  if (svg.find("a &amp; &lt;b&gt;") == std::string::npos) return "no name in " + svg;
  for (const char* wrong : {"& ", "<b>"})
    if (svg.find(wrong) != std::string::npos) return wrong;
  return "";
}
}  // namespace

TEST_SUITE("tools/svg") {
  TEST_CASE("elements stand within each other, and end in the order in which they must") {
    Svg svg;
    svg.declaration().begin("svg", {{"width", "8"}, {"height", "6"}}).line_end();
    svg.begin("g").element("rect", {{"x", "1"}}).element("text", {}, "one").end().line_end();
    svg.style("a{}\n").begin("text").words("two").element("tspan", {{"x", "2"}}, "three").words("four").end().end();
    CHECK(svg.text() ==
          "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
          "<svg width=\"8\" height=\"6\">\n"
          "<g><rect x=\"1\"/><text>one</text></g>\n"
          "<style>\na{}\n</style>\n"
          "<text>two<tspan x=\"2\">three</tspan>four</text></svg>");
  }

  TEST_CASE("neither words nor values of attributes can end where they stand") {
    Svg svg;
    svg.element("text", {{"class", "\"/><script>'"}}, "</text>&'\n");
    CHECK(svg.text() == "<text class=\"&quot;/&gt;&lt;script&gt;'\">&lt;/text&gt;&amp;&#39;\\n</text>");
  }

  TEST_CASE("numbers have the decimals that are asked for, and pixels at most two") {
    CHECK(fixed(1.25, 1) == "1.2");
    CHECK(fixed(-3, 0) == "-3");
    CHECK(fixed(1e300, 0).size() == 301);
    CHECK(px(1.005) == "1");
    CHECK(px(12.5) == "12.5");
    CHECK(px(100) == "100");
    CHECK(px(-0.001) == "0");
  }

  TEST_CASE("the name of a graph may be full of markup") {
    const command::TemporaryFolder folder;
    const std::string file = folder.write("markup.yaml",
                                          "graph: 'a & <b>'\ntiming: {period: 10ms}\nplatform: {policy: table}\n"
                                          "tasks:\n  count: {type: Counter, wcet: 10us}\n");
    for (const std::string& command :
         {"graph " + file + " --svg", "check " + file + " --svg -", "run " + file + " --for 1s --plot -"}) {
      CAPTURE(command);
      CHECK(markup_of_names(command::run_jarol(command, "2>/dev/null").output) == "");
    }
  }
}

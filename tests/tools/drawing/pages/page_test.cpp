// How a page is put together; tests/pages has what a browser makes of it.
#include "tools/drawing/pages/page.h"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "tests/tools/run_command.h"
#include "tools/commands/log/report_signals.h"

namespace {
using namespace jarol::tools;
using command::content;
using command::TemporaryFolder;
using nlohmann::json;

std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t first = text.find(begin) + begin.size();
  return text.substr(first, text.find(end, first) - first);
}

json data_of(const std::string& page) { return json::parse(between(page, "id=\"data\">", "</script>")); }

std::vector<double> doubles(const std::string& base64) {
  const std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<double> numbers;
  std::uint64_t bits = 0;
  int bytes = 0, held = 0;
  std::uint32_t pool = 0;
  for (const char c : base64) {
    if (c == '=') break;
    pool = pool << 6U | static_cast<std::uint32_t>(digits.find(c));
    if ((held += 6) < 8) continue;
    held -= 8;
    bits |= std::uint64_t{pool >> held & 0xffU} << (8 * bytes);
    if (++bytes < 8) continue;
    numbers.push_back(std::bit_cast<double>(bits));
    bits = 0;
    bytes = 0;
  }
  return numbers;
}
}  // namespace

TEST_SUITE("tools/drawing/pages") {
  TEST_CASE("what stands in a page's data and title is no markup, and what is no number is null") {
    const nlohmann::ordered_json data{{"text", "</script><!-- \xff"},
                                      {"nan", std::numeric_limits<double>::quiet_NaN()}};
    const std::string page = page_of("a <b>", {"base.js"}, data);
    CHECK(page.find("<title>a &lt;b&gt;</title>") != std::string::npos);
    const json read = data_of(page);
    CHECK(read.at("text") == "</script><!-- \xef\xbf\xbd");
    CHECK(read.at("nan").is_null());
    CHECK(page.find("default-src 'none'; base-uri 'none'; form-action 'none'; img-src data:; script-src 'sha256-") !=
          std::string::npos);
  }

  TEST_CASE("modules stand in a page as one, without what they import and export") {
    const std::string script =
        between(page_of("", {"base.js", "data.js"}, {}), "<script type=\"module\">", "</script>");
    CHECK(script.find("\nimport ") == std::string::npos);
    CHECK(script.find("\nexport ") == std::string::npos);
    CHECK(script.find("\nfunction duration(") < script.find("\nclass Signal {"));
  }

  TEST_CASE("numbers are their bytes") {
    CHECK(base64_of(std::vector<double>{1.0}) == "AAAAAAAA8D8=");
    const std::vector<double> some{0.1, -0.0, 1e300, std::numeric_limits<double>::infinity()};
    const std::vector<double> read = doubles(base64_of(some));
    REQUIRE(read.size() == some.size());
    for (std::size_t i = 0; i < some.size(); ++i)
      CHECK(std::bit_cast<std::uint64_t>(read[i]) == std::bit_cast<std::uint64_t>(some[i]));
  }

  TEST_CASE("of a large recording a page has the least and the greatest of each piece of time, and nothing of others") {
    const TemporaryFolder folder;
    const std::string file = folder / "r.mcap",
                      graph = folder.write("g.yaml",
                                           "graph: g\ntasks:\n  a: {type: Counter, period: 1ms}\n"
                                           "  b: {type: Counter, period: 10ms}\n");
    REQUIRE(command::run_jarol("run " + graph + " --for 10s --record " + file).exit_code == 0);
    REQUIRE(command::run_jarol("log report " + file).output == "  report      " + (folder / "r.html") + "\n");
    const json data = data_of(content(folder / "r.html"));
    REQUIRE(data.at("signals").size() == 2);
    const json& a = data["signals"][0];
    CHECK(a["name"] == "a.out");
    CHECK(a["min"] == 0);
    CHECK(a["max"] == 9999);
    const std::int64_t piece = data["topics"][0]["piece_ns"];
    const std::vector<double> low = doubles(a["low"]), high = doubles(a["high"]);
    CHECK(low.size() == 2048);
    // value k is published at k ms
    for (std::size_t i = 0; i < low.size(); ++i) {
      const auto at = static_cast<std::int64_t>(i);
      CHECK(low[i] == std::ceil(static_cast<double>(at * piece) / 1e6));
      CHECK(high[i] == std::min(9999.0, std::ceil(static_cast<double>((at + 1) * piece) / 1e6) - 1));
    }
    // few values are all there
    CHECK(doubles(data["signals"][1]["values"]).size() == 1000);
    CHECK(data["topics"][1]["times"] == json{{"first_ns", 0}, {"step_ns", 10'000'000}, {"count", 1000}});
    CHECK(data["replay"]["evidence"] == "same");
    CHECK(data["replay"]["compared"] == 11'000);
  }

  TEST_CASE("a page of very many signals has fewer values of each") {
    CHECK(thinning_for(10).max_values == 4096);
    CHECK(thinning_for(10'000).max_values == 400);
    CHECK(thinning_for(1'000'000).pieces == 128);
  }

  TEST_CASE("places are fields x and y with one of depth or height, all in metres") {
    const auto signal = [](const char* name, const char* unit) {
      return nlohmann::ordered_json{{"name", name}, {"unit", unit}};
    };
    const auto signals = nlohmann::ordered_json::array(
        {signal("a.out.altitude", "m"), signal("a.out.x", "m"), signal("a.out.y", "m"), signal("b.x", "m"),
         signal("b.y", "m"), signal("b.z", "m"), signal("c.x", "rad"), signal("c.y", "m"), signal("c.z", "m")});
    CHECK(paths_json(signals) ==
          nlohmann::ordered_json::array({{{"name", "a.out"}, {"x", 1}, {"y", 2}, {"z", 0}, {"down", false}},
                                         {{"name", "b"}, {"x", 3}, {"y", 4}, {"z", 5}, {"down", true}}}));
  }

  TEST_CASE("the graph of a recording with plugins is not loaded, and its report says so") {
    const TemporaryFolder folder;
    const std::string plugins = std::filesystem::absolute(JAROL_PLUGIN_FOLDER), file = folder / "r.mcap",
                      out = folder / "r.html",
                      graph =
                          folder.write("g.yaml", "graph: g\nplugins: [" + plugins +
                                                     "/low_pass.so]\ntasks:\n  c: {type: Counter, period: 10ms}\n  l: "
                                                     "{type: LowPass, period: 10ms}\nconnections: [c.out -> l.in]\n");
    REQUIRE(command::run_jarol("run " + graph + " --for 100ms --record " + file).exit_code == 0);
    CHECK(command::run_jarol("log report " + file).exit_code == 0);
    const json data = data_of(content(out));
    CHECK(data["no_graph"].get<std::string>().find("name it yourself: jarol log report FILE GRAPH") !=
          std::string::npos);
    CHECK(data["signals"].size() == 2);
    CHECK(!data.contains("drawing"));
    CHECK(command::run_jarol("log report " + file + " " + graph).exit_code == 0);
    CHECK(data_of(content(out))["tasks"].size() == 2);
    // no page replaces what it is made of
    CHECK(command::run_jarol("log report " + file + " -o " + file).exit_code == 2);
  }
}

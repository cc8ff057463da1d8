#include "graph/language/yaml.h"

#include <doctest/doctest.h>

#include <ctime>

#include "graph/language/read_source.h"
#include "tests/graph/language/yaml_text.h"

namespace {
using namespace jarol;

using tests::report_on_yaml;
using tests::tree_of;
}  // namespace

TEST_SUITE("graph/yaml") {
  TEST_CASE("every value and key knows its line and column") {
    const Yaml yaml = tree_of("a: 1\nb: {c: 'x', d: [2, 3]}\n");
    const Yaml* b = yaml.find("b");
    REQUIRE(b != nullptr);
    CHECK(b->key_where.line == 2);
    CHECK(b->where.column == 4);
    const Yaml* c = b->find("c");
    REQUIRE(c != nullptr);
    CHECK(c->quoted);
    CHECK(c->where.column == 8);
    REQUIRE(b->find("d") != nullptr);
    CHECK(b->find("d")->children.at(1).text == "3");
  }

  TEST_CASE("an alias stands for a copy of what it refers to") {
    const Yaml yaml = tree_of("a: &x {k: 1}\nb: *x\n");
    REQUIRE(yaml.find("b") != nullptr);
    REQUIRE(yaml.find("b")->find("k") != nullptr);
    CHECK(yaml.find("b")->find("k")->text == "1");
  }

  TEST_CASE("a key that appears twice is an error that shows both") {
    CHECK(report_on_yaml("a: 1\nb: 2\na: 3\n") ==
          "t.yaml:3:1: error: key 'a' appears twice in one mapping; keep one\n"
          "  a: 3\n"
          "  ^\n"
          "t.yaml:1:1: note: first here\n"
          "  a: 1\n"
          "  ^");
  }

  TEST_CASE("a key that appears twice is an error however each of the two is quoted") {
    for (const std::string first : {"a", "'a'", "\"a\""})
      for (const std::string second : {"a", "'a'", "\"a\"", "\"\\x61\""})
        CHECK(report_on_yaml(first + ": 1\n" + second + ": 3\n")
                  .starts_with("t.yaml:2:1: error: key 'a' appears twice in one mapping; keep one\n"));
  }

  TEST_CASE("a key that appears twice is an error however many there are") {
    for (const int keys : {2, 15, 16, 17, 18, 1000})
      for (const int twice : {0, keys / 2, keys - 1}) {
        std::string text;
        for (int i = 0; i < keys; ++i) text += "k" + std::to_string(i) + ": 1\n";
        CHECK(report_on_yaml(text + "k" + std::to_string(twice) + ": 2\n")
                  .starts_with("t.yaml:" + std::to_string(keys + 1) + ":1: error: key 'k" + std::to_string(twice) +
                               "' appears twice in one mapping; keep one\n"));
      }
  }

  TEST_CASE("a merge key is an error") {
    CHECK(report_on_yaml("a: &x {k: 1}\nb:\n  <<: *x\n") ==
          "t.yaml:3:3: error: merge key '<<' is not supported; write the keys out, or use a profile\n"
          "    <<: *x\n"
          "    ^");
  }

  TEST_CASE("an alias to what contains it is an error") {
    CHECK(report_on_yaml("a: &x\n  b: *x\n") ==
          "t.yaml:2:6: error: an alias stands inside the very value it refers to; a value can't contain itself\n"
          "    b: *x\n"
          "       ^");
  }

  TEST_CASE("a tag is an error") {
    CHECK(report_on_yaml("a: !foo 1\n") ==
          "t.yaml:1:4: error: tag '!foo' is not supported; leave it out\n"
          "  a: !foo 1\n"
          "     ^");
  }

  TEST_CASE("a second document is an error") {
    CHECK(report_on_yaml("a: 1\n---\nb: 2\n") ==
          "t.yaml:3:1: error: a second document begins here; a file holds one\n"
          "  b: 2\n"
          "  ^");
  }

  TEST_CASE("a syntax error has its place") {
    CHECK(report_on_yaml("a: [1, 2\nb: 3\n") ==
          "t.yaml:2:2: error: not valid YAML: did not find expected ',' or ']'\n"
          "  b: 3\n"
          "   ^\n"
          "t.yaml:1:4: note: while parsing a flow sequence, from here on\n"
          "  a: [1, 2\n"
          "     ^");
    CHECK(report_on_yaml("a: b: c\n") ==
          "t.yaml:1:5: error: not valid YAML: mapping values are not allowed in this context\n"
          "  a: b: c\n"
          "      ^");
  }

  TEST_CASE("an alias without an anchor is an error") {
    CHECK(report_on_yaml("a: *x\nb: &x 1\n") ==
          "t.yaml:1:4: error: alias '*x' has no anchor before it; write '&x' before what it is to stand for\n"
          "  a: *x\n"
          "     ^");
    // a name may be another's later on
    const Yaml yaml = tree_of("a: &x 1\nb: *x\nc: &x 2\nd: *x\n");
    CHECK(yaml.find("b")->text == "1");
    CHECK(yaml.find("d")->text == "2");
    CHECK(report_on_yaml("a: &x 1\nb: &x [*x]\n")
              .starts_with("t.yaml:2:8: error: an alias stands inside the very value"));
  }

  TEST_CASE("nothing, ~ and null are nothing, but for what stands in quotes") {
    const Yaml yaml = tree_of("{a: , b: ~, c: null, d: NULL, e: Null, f: 'null', g: \"\", h: nUll, i}\n");
    for (const char* const key : {"a", "b", "c", "d", "e", "i"}) CHECK(yaml.find(key)->kind == Yaml::Kind::null);
    for (const char* const key : {"f", "g", "h"}) CHECK(yaml.find(key)->kind == Yaml::Kind::scalar);
  }

  TEST_CASE("absurd depth is an error, not a crash") {
    const std::string text(200, '[');
    CHECK(report_on_yaml(text + std::string(200, ']'))
              .starts_with("t.yaml:1:65: error: values are nested deeper than 64 levels\n"));
  }

  TEST_CASE("aliases that multiply end in an error, not in a full memory") {
    std::string text = "a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
    for (int i = 1; i < 10; ++i) {
      const std::string last = "*a" + std::to_string(i - 1);
      text += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + last;
      for (int j = 1; j < 10; ++j) text += ", " + last;
      text += "]\n";
    }
    CHECK(report_on_yaml(text).starts_with("t.yaml:5:45: error: aliases stand for more than 100000 values\n"));
  }

  TEST_CASE("anchors that multiply do too") {
    std::string text = "a: ";
    for (int i = 0; i < 60; ++i) text += "&a" + std::to_string(i) + " [";
    text += "0";
    for (int i = 0; i < 1700; ++i) text += ",0";
    CHECK(report_on_yaml(text + std::string(60, ']'))
              .starts_with("t.yaml:1:14: error: anchors name more than 100000 values\n"));
  }

  TEST_CASE("a text of too many values is an error") {
    std::string text = "a: [\n1";
    for (int i = 0; i < 6'000'000; ++i) text += ",\n123456";
    CHECK(report_on_yaml(text + "]").starts_with("t.yaml:6000001:1: error: the text holds more than 6000000 values\n"));
  }

  TEST_CASE("so is one of many values that take next to no text each, long before its end") {
    const std::string empty = "error: more than 100000 values are empty\n";
    const std::string close = "error: more than 100000 values stand so close that each takes less than 4 bytes\n";
    const auto repeated = [](const std::string& piece) {
      std::string text;
      for (int i = 0; i < 1'000'000; ++i) text += piece;
      return text;
    };
    const auto wrong = [](const std::string& text) {
      const std::string report = report_on_yaml(text);
      const std::size_t end = report.find(' ');
      return report.substr(end + 1, report.find('\n') - end);
    };
    for (const char* const piece : {"-\n", "- []\n", "- {}\n", "- ''\n"}) CHECK(wrong(repeated(piece)) == empty);
    CHECK(wrong(repeated("- [a,b,c,d]\n")) == close);
    std::string keys;
    for (int i = 0; i < 1'000'000; ++i) keys += std::to_string(i) + ":\n";
    CHECK(wrong(keys) == empty);
    std::string few;
    for (int i = 1; i < 100'000; ++i) few += "-\n";
    CHECK(report_on_yaml(few) == "");
  }

  TEST_CASE("a large graph may be written as tersely as can be") {
    std::string text = "tasks:\n";
    for (int i = 0; i < 120'000; ++i) text += " t" + std::to_string(i) + ": {type: Sum, period: 1ms}\n";
    CHECK(report_on_yaml(text) == "");
  }

  TEST_CASE("a text of more than 64 MiB is not read at all") {
    std::string text = "a: 1\n";
    while (text.size() < max_source_bytes) text += "#" + std::string(15, '#') + "\n";
    text.resize(max_source_bytes + 1);
    CHECK(report_on_yaml(text) ==
          "t.yaml:1:1: error: the text is larger than 64 MiB\n"
          "  a: 1\n"
          "  ^");
  }

  TEST_CASE("what is repeated for ten megabytes ends soon, and takes little memory") {
    for (const std::string token :
         {"[",   "{",    "[\n", "\n",  "- ",  "? ",  ": ",     ",",       "\"",  "'",  "!a ",    "&a ",   "*a ",
          "#",   "\t",   " ",   "a",   "a ",  "a\n", "a: b\n", "%\n",     "|\n", ">",  "---\n",  "...\n", "[]",
          "[],", "\xff", "\r",  "{\"", "? [", "a: ", "[a,",    "[\"a\":", "- [", "\\", "\"a\" ", "\n "}) {
      CAPTURE(token);
      std::string text;
      while (text.size() < 10'000'000) text += token;
      const std::clock_t start = std::clock();  // of the processor: others may take their time from it
      const bool is_yaml = report_on_yaml(text).empty();
      CHECK(std::clock() - start < 3 * CLOCKS_PER_SEC);
      // a remark, a text, nothing at all
      for (const char* const valid : {"#", "'", " ", "\n", "a", "a ", "a\n", "\\", "\n "})
        if (token == valid) CHECK(is_yaml);
      for (const char* const invalid : {"[", "{", "\t", "\r", "\xff", "? ", "- ", "[\n", "a: ", "[]", ">"})
        if (token == invalid) CHECK_FALSE(is_yaml);
    }
    // a graph of ten thousand tasks in one line, as a program may write it
    std::string json = "{\"graph\": \"g\", \"tasks\": {";
    for (int i = 0; i < 10'000; ++i)
      json +=
          (i == 0 ? "\"t" : ", \"t") + std::to_string(i) + R"(": {"type": "Counter", "period": "10ms", "wcet": "1us"})";
    CHECK(report_on_yaml(json + "}}") == "");
  }

  TEST_CASE("of a long line only what surrounds the place is shown, and nothing that could harm a terminal") {
    const std::string before(300, 'x'), after(300, 'y');
    CHECK(report_on_yaml("a: \"" + before + "\"\nb: 1\n\x1b[0m: 2\n").find('\x1b') == std::string::npos);
    CHECK(report_on_yaml("{a" + before + ": 1, b: 2, b: 3, c" + after + ": 4}\n") ==
          "t.yaml:1:314: error: key 'b' appears twice in one mapping; keep one\n"
          "  ..." +
              std::string(109, 'x') + ": 1, b: 2, b: 3, c" + std::string(33, 'y') +
              "...\n"
              "     " +
              std::string(120, ' ') +
              "^\n"
              "t.yaml:1:308: note: first here\n"
              "  ..." +
              std::string(115, 'x') + ": 1, b: 2, b: 3, c" + std::string(27, 'y') +
              "...\n"
              "     " +
              std::string(120, ' ') + "^");
  }

  TEST_CASE("a word close to a known one is suggested") {
    const std::vector<std::string> known{"period", "offset", "let"};
    CHECK(did_you_mean("peroid", known) == "; did you mean 'period'?");
    CHECK(did_you_mean("lte", known) == "; did you mean 'let'?");
    CHECK(did_you_mean("colour", known) == "");
  }
}

// What of a text is YAML at all, and where its places are.
#include <doctest/doctest.h>

#include <ctime>

#include "tests/graph/language/yaml_text.h"

namespace {
using namespace jarol;

using tests::report_on_yaml;
using tests::tree_of;
}  // namespace

TEST_SUITE("graph/yaml_events") {
  TEST_CASE("what is no text in UTF-8 is an error at its byte") {
    const auto wrong = [](const std::string& text) {
      const std::string report = report_on_yaml(text);
      return report.substr(0, report.find('\n'));
    };
    CHECK(wrong("a: 1\nb: \xff\n") == "t.yaml:2:4: error: not valid YAML: no UTF-8 from here on: 0xff");
    // of another encoding: what should have followed it does not
    CHECK(wrong("# caf\xe9\na: 1\n") == "t.yaml:1:6: error: not valid YAML: no UTF-8 from here on: 0xe9");
    CHECK(wrong("# \xe2\x80x\na: 1\n") == "t.yaml:1:3: error: not valid YAML: no UTF-8 from here on: 0xe2");
    CHECK(wrong("# \xe2\x82\xac\x80\na: 1\n") == "t.yaml:1:6: error: not valid YAML: no UTF-8 from here on: 0x80");
    CHECK(wrong("# \xe2\x82") == "t.yaml:1:3: error: not valid YAML: no UTF-8 from here on: 0xe2");
    CHECK(wrong("a: \x80\n") == "t.yaml:1:4: error: not valid YAML: no UTF-8 from here on: 0x80");
    CHECK(wrong("\xff\xfe"
                "a") == "t.yaml:1:1: error: not valid YAML: no UTF-8 from here on: 0xff");
    CHECK(wrong("a: 1\n# \xc3\xa4\nb: \x1b[0m\n") ==
          "t.yaml:3:4: error: not valid YAML: control characters are not allowed: 0x1b");
    CHECK(wrong(std::string("a: 1\nb: x\0y\n", 11)) ==
          "t.yaml:2:5: error: not valid YAML: control characters are not allowed: 0x00");
  }

  TEST_CASE("the mark that editors of Windows set in front is no part of the text") {
    CHECK(tree_of("\xef\xbb\xbf"
                  "a: 1\nb: 2\n")
              .children.size() == 2);
    CHECK(report_on_yaml("\xef\xbb\xbf"
                         "a: 1\na: 2\n")
              .starts_with("t.yaml:2:1: error: key 'a' appears twice"));
    CHECK(report_on_yaml("\xef\xbb\xbf"
                         "a: 1\nb: \xff\n")
              .starts_with("t.yaml:2:4: error: not valid YAML: no UTF-8"));
  }

  TEST_CASE("lines end where an editor ends them, and columns count bytes") {
    CHECK(report_on_yaml("a: 1\r\nb: \"\xc3\xa4\"\r\na: 2\r\n")
              .starts_with("t.yaml:3:1: error: key 'a' appears twice in one mapping; keep one\n"));
    CHECK(report_on_yaml("{\xc3\xa4: 1, \xc3\xa4: 2}\n")
              .starts_with("t.yaml:1:9: error: key '\xc3\xa4' appears twice in one mapping; keep one\n"));
    // what would hide a line in a remark
    CHECK(report_on_yaml("# see\xc2\x85"
                         "a: 1\n")
              .starts_with("t.yaml:1:6: error: not valid YAML: it ends a line here, by U+0085, where no editor does; "
                           "leave it out\n"));
    CHECK(report_on_yaml("a: 'x\xe2\x80\xa8y'\n")
              .starts_with("t.yaml:1:6: error: not valid YAML: it ends a line here, by U+2028"));
    CHECK(report_on_yaml("a: x\xe2\x80\xa9\n")
              .starts_with("t.yaml:1:5: error: not valid YAML: it ends a line here, by U+2029"));
    for (const char* const text : {"# see\ra: 1\n", "a: 1\r"})
      CHECK(report_on_yaml(text).find(
                "error: not valid YAML: a line ends with CR alone; end lines with LF, or CR LF\n") !=
            std::string::npos);
  }

  TEST_CASE("a tab is named, wherever it can't stand") {
    CHECK(report_on_yaml("a:\n\tb: 1\n")
              .starts_with("t.yaml:2:1: error: not valid YAML: a tab can't indent a line; indent with blanks\n"));
    CHECK(report_on_yaml("-\ta: 1\n\n").find("a tab can't stand here; write blanks") != std::string::npos);
    CHECK(report_on_yaml("{a: 1,\n\tb: 2}\n") == "");
  }

  TEST_CASE("lines of %TAG, which take long, are refused before they are read") {
    std::string text;
    for (int i = 0; i < 100'000; ++i) text += "%TAG !t" + std::to_string(i) + "! x\n";
    const std::clock_t start = std::clock();
    CHECK(report_on_yaml("# remark\n" + text + "---\na: 1\n")
              .starts_with("t.yaml:2:1: error: tags are not supported; leave the line out\n"));
    CHECK(report_on_yaml("a: 1\n...\n" + text + "---\nb: 1\n").starts_with("t.yaml:3:1: error: tags are"));
    CHECK(std::clock() - start < CLOCKS_PER_SEC);
    CHECK(report_on_yaml("a: 'x %TAG'\n") == "");
  }
}

#include "graph/text/escape.h"

#include <doctest/doctest.h>

namespace {
using namespace jarol;

std::string utf8_of(char32_t code) {
  const auto byte = [](char32_t value) { return static_cast<char>(static_cast<unsigned char>(value)); };
  if (code < 0x80) return {byte(code)};
  if (code < 0x800) return {byte(0xc0 | code >> 6), byte(0x80 | (code & 0x3f))};
  if (code < 0x10000) return {byte(0xe0 | code >> 12), byte(0x80 | ((code >> 6) & 0x3f)), byte(0x80 | (code & 0x3f))};
  return {byte(0xf0 | code >> 18), byte(0x80 | ((code >> 12) & 0x3f)), byte(0x80 | ((code >> 6) & 0x3f)),
          byte(0x80 | (code & 0x3f))};
}
}  // namespace

TEST_SUITE("graph/text") {
  TEST_CASE("words of any language stay as they are") {
    for (const char* text : {"", "depth_control", "a & <b>", "Höhe 3 µs", "深さ", "Ελλάδα", "\U0001f681", "a\\b"})
      CHECK(printable(text) == text);
  }

  TEST_CASE("what a terminal would obey is shown as an escape") {
    CHECK(printable("a\x1b[31mred\x07") == "a\\x1b[31mred\\x07");
    CHECK(printable("one\ntwo\tthree\r") == "one\\ntwo\\tthree\\r");
    CHECK(printable(std::string_view("a\0b\x7f", 4)) == "a\\x00b\\x7f");
    CHECK(printable("\u009b31m\u0085") == "\\u009b31m\\u0085");                       // C1: CSI in one character
    CHECK(printable("\u202egnp.exe\u2066\u200f") == "\\u202egnp.exe\\u2066\\u200f");  // turns the direction
    CHECK(printable("\ufeffa\u200bb\u2028") == "\\ufeffa\\u200bb\\u2028");
    CHECK(printable("\U000e0041") == "\\U000e0041");  // a tag, never seen
  }

  TEST_CASE("bytes that are no UTF-8 are shown as such") {
    CHECK(printable("a\xff\x9b") == "a\\xff\\x9b");
    CHECK(printable("\xc3") == "\\xc3");                             // cut off
    CHECK(printable("\xc3(") == "\\xc3(");                           // not continued
    CHECK(printable("\xc0\xaf") == "\\xc0\\xaf");                    // too long for what it says
    CHECK(printable("\xe0\x80\x9b") == "\\xe0\\x80\\x9b");           // likewise, a C1 hidden in it
    CHECK(printable("\xed\xa0\x80") == "\\xed\\xa0\\x80");           // half a pair of UTF-16
    CHECK(printable("\xf4\x90\x80\x80") == "\\xf4\\x90\\x80\\x80");  // beyond Unicode
  }

  TEST_CASE("every character is shown as it is or as ASCII, and what is shown is not escaped again") {
    for (char32_t code = 0; code <= 0x10ffff; ++code) {
      if (code >= 0xd800 && code <= 0xdfff) continue;
      const std::string text = utf8_of(code);
      const Character c = first_character(text);
      REQUIRE(c.size == text.size());
      REQUIRE(c.code == code);
      REQUIRE(c.utf8);
      const std::string shown = printable(text);
      REQUIRE(printable(shown) == shown);
      REQUIRE(c.printable == (shown == text));
      if (code < 0x20 || (code >= 0x7f && code < 0xa0)) REQUIRE(!c.printable);
    }
  }

  TEST_CASE("a text of lines keeps its lines") { CHECK(printable_lines("a:\n\tb\x1b\r\n") == "a:\n\tb\\x1b\\r\n"); }

  TEST_CASE("in XML, DOT and CSV a text can't leave its place") {
    CHECK(xml_text("a & <b> \"c'd\x1b\n") == "a &amp; &lt;b&gt; &quot;c&#39;d\\x1b\\n");
    CHECK(xml_attribute("a & <b> \"c'd\x1b\n") == "a &amp; &lt;b&gt; &quot;c'd\\x1b\\n");
    CHECK(dot_text("a\"]; b [x=\"\\") == R"(a\"]; b [x=\"\\)");
    CHECK(dot_text("a\nb") == R"(a\\nb)");
    CHECK(csv_text("a.b") == "a.b");
    CHECK(csv_text("a,b") == "\"a,b\"");
    CHECK(csv_text("say \"no\"") == "\"say \"\"no\"\"\"");
    CHECK(csv_text("a\nb") == "\"a\nb\"");
    CHECK(csv_text("a\x1b[2J") == "a\\x1b[2J");
  }
}

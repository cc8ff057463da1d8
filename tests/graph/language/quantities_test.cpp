#include "graph/language/quantities.h"

#include <doctest/doctest.h>

#include <tuple>
#include <utility>

TEST_SUITE("graph/yaml/quantities") {
  using namespace jarol;

  Duration duration_of(const char* text) {
    Duration duration{};
    CHECK(parse_duration(text, duration) == "");
    return duration;
  }

  std::string wrong_duration(const char* text) {
    Duration duration{};
    return parse_duration(text, duration);
  }

  std::string wrong_number(const char* text, const char* unit) {
    double number = 0;
    return parse_number(text, unit, number);
  }

  TEST_CASE("a duration is a number with a unit, exact to the nanosecond") {
    CHECK(duration_of("10ms").count() == 10'000'000);
    CHECK(duration_of("2.5us").count() == 2'500);
    CHECK(duration_of("0.1 s").count() == 100'000'000);
    CHECK(duration_of("-3ns").count() == -3);
    CHECK(duration_of("1.000000001s").count() == 1'000'000'001);
    CHECK(duration_of("1h").count() == 3'600'000'000'000);
    CHECK(duration_of("0ms").count() == 0);
  }

  TEST_CASE("what is no duration says why") {
    CHECK(wrong_duration("10") == "has no unit; write one of h, min, s, ms, us or ns, as in 10ms");
    CHECK(wrong_duration("10 sec") == "has the unit 'sec'; write one of h, min, s, ms, us or ns");
    CHECK(wrong_duration("2.5ns") == "is not a whole number of nanoseconds");
    CHECK(wrong_duration("010ms") == "begins with a zero; write it without");
    CHECK(wrong_duration("soon") == "is not a duration; write a number and a unit, as in 10ms");
    CHECK(wrong_duration("1e3ms") == "is not a duration; write a number and a unit, as in 10ms");
    CHECK(wrong_duration("9999999999h") == "is too large");
    CHECK(wrong_duration("1.2.3s") == "is not a number");
    CHECK(wrong_duration("") == "is not a duration; write a number and a unit, as in 10ms");
  }

  TEST_CASE("a number may carry its own unit or one that converts to it") {
    double number = 0;
    CHECK(parse_number("15deg", "rad", number) == "");
    CHECK(number == doctest::Approx(0.2617993877991494).scale(0).epsilon(1e-15));
    CHECK(parse_number("0.6 rad/m", "rad/m", number) == "");
    CHECK(number == 0.6);
    CHECK(parse_number("-2e-3", "m", number) == "");
    CHECK(number == -0.002);
  }

  TEST_CASE("what is no number says why") {
    CHECK(wrong_number("010", "") == "begins with a zero; write it without");
    CHECK(wrong_number("fast", "") == "is not a number");
    CHECK(wrong_number("0x10", "") == "has the unit 'x10'; it has none");
    CHECK(wrong_number("5 kg", "m") == "has the unit 'kg'; it is in m");
    CHECK(wrong_number("1e400", "") == "is beyond what a double holds");
    CHECK(wrong_number(".inf", "") == "is not a number");
    CHECK(wrong_number("nan", "") == "is not a number");
    CHECK(wrong_number("", "") == "is not a number");
  }

  TEST_CASE("integers and sizes are strict too") {
    std::int64_t integer = 0;
    CHECK(parse_integer("-7", -10, 10, integer) == "");
    CHECK(integer == -7);
    CHECK(parse_integer("11", -10, 10, integer) == "is not from -10 to 10");
    CHECK(parse_integer("99999999999999999999", -10, 10, integer) == "is not from -10 to 10");
    CHECK(parse_integer("1.5", -10, 10, integer) == "is not an integer");
    CHECK(parse_bytes("64KiB", integer) == "");
    CHECK(integer == 65536);
    CHECK(parse_bytes("64", integer) == "has no unit; write one of B, KiB, MiB or GiB, as in 64KiB");
    CHECK(parse_bytes("-1B", integer) == "is not a size; write a number and a unit, as in 64KiB");
  }

  TEST_CASE("ids are written in hex or decimal") {
    std::int64_t id = 0;
    for (const char* text : {"0x00D1", "0x00d1", "0XD1", "209"}) {
      CAPTURE(text);
      id = 0;
      CHECK(parse_id(text, 65535, id) == "");
      CHECK(id == 209);
    }
    CHECK(parse_id("0", 65535, id) == "");
    CHECK(id == 0);
    const std::string no_id = "is not an id; write it in hex or decimal, as in 0x00D1 or 209";
    for (const char* text : {"", "0x", "0xG1", "0x 1", "0x-1", "-1", "+1", "D1", "1.5", "209 ", "0x0x1"}) {
      CAPTURE(text);
      CHECK(parse_id(text, 65535, id) == no_id);
    }
    CHECK(parse_id("0209", 65535, id) == "begins with a zero; write it without, or in hex, as in 0x00D1");
    CHECK(parse_id("0x10000", 65535, id) == "is not from 0 to 65535");
    CHECK(parse_id("0x10000000000000000", 65535, id) == "is not from 0 to 65535");
    CHECK(id == 0);
  }

  TEST_CASE("durations and numbers come back as text") {
    CHECK(duration_text(Duration(1'500'000)) == "1.5ms");
    CHECK(duration_text(Duration(20'000)) == "20us");
    CHECK(duration_text(Duration(0)) == "0ns");
    CHECK(duration_text(Duration(-2'000'000'000)) == "-2s");
    CHECK(seconds_text(Duration(50'000'000)) == "0.05");
    CHECK(seconds_text(Duration(12'000'000'000)) == "12");
    CHECK(seconds_text(Duration(1)) == "0.000000001");
    CHECK(number_text(0.1) == "0.1");
    CHECK(number_text(0.1F) == "0.1");
  }

  TEST_CASE("every unit that converts is worth what it is") {
    const double degree = 3.14159265358979323846 / 180;
    const std::tuple<const char*, const char*, double> units[] = {
        {"1deg", "rad", degree},     {"1mrad", "rad", 0.001},     {"1Hz", "rad/s", 360 * degree},
        {"1deg/s", "rad/s", degree}, {"1mrad/s", "rad/s", 0.001}, {"1km", "m", 1000},
        {"1cm", "m", 0.01},          {"1mm", "m", 0.001},         {"1cm/s", "m/s", 0.01},
        {"1mm/s", "m/s", 0.001},     {"1min", "s", 60},           {"1ms", "s", 0.001},
        {"1us", "s", 1e-6},          {"1g", "kg", 0.001},         {"1kN", "N", 1000}};
    for (const auto& each : units) {
      const std::string text = std::get<0>(each);
      CAPTURE(text);
      double number = 0;
      CHECK(parse_number(text, std::get<1>(each), number) == "");
      CHECK(number == doctest::Approx(std::get<2>(each)).scale(0).epsilon(1e-15));
    }
    const std::pair<const char*, std::int64_t> durations[] = {
        {"1h", 3'600'000'000'000}, {"1min", 60'000'000'000}, {"1s", 1'000'000'000},
        {"1ms", 1'000'000},        {"1us", 1'000},           {"1ns", 1}};
    for (const auto& [text, nanoseconds] : durations) {
      Duration duration{};
      CHECK(parse_duration(text, duration) == "");
      CHECK(duration.count() == nanoseconds);
    }
    const std::pair<const char*, std::int64_t> sizes[] = {
        {"1B", 1}, {"1KiB", 1024}, {"1MiB", 1024 * 1024}, {"1GiB", 1024 * 1024 * 1024}};
    for (const auto& [text, bytes] : sizes) {
      std::int64_t size = 0;
      CHECK(parse_bytes(text, size) == "");
      CHECK(size == bytes);
    }
  }
}

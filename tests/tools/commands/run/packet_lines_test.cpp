// Packets as lines of text, there and back.
#include "tools/commands/run/packet_lines.h"

#include <doctest/doctest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "distributers/messages/imc.h"
#include "distributers/messages/javiator.h"

using namespace jarol;
using nlohmann::json;

namespace {

struct Result {
  int exit_code = -1;
  std::vector<std::string> lines;
  std::string errors;
};

Result turn(decltype(tools::decode_lines) turn_lines, const messages::MessageSet& set, const std::string& text) {
  std::istringstream in(text);
  std::ostringstream out, errors;
  Result result;
  result.exit_code = turn_lines(set, in, out, errors);
  std::istringstream lines(out.str());
  for (std::string line; std::getline(lines, line);) result.lines.push_back(line);
  result.errors = errors.str();
  return result;
}

const messages::MessageSet& imc_set = messages::imc::message_set();
const messages::MessageSet& javiator_set = messages::javiator::message_set();

Result decode(const std::string& text, const messages::MessageSet& set = imc_set) {
  return turn(tools::decode_lines, set, text);
}
Result encode(const std::string& text, const messages::MessageSet& set = imc_set) {
  return turn(tools::encode_lines, set, text);
}

}  // namespace

TEST_SUITE("tools/packet_lines") {
  TEST_CASE("recorded packets have the fields that were recorded with them, and come back byte for byte") {
    for (const auto& [set, file] :
         {std::pair{&imc_set, "imc-packets.jsonl"}, std::pair{&javiator_set, "javiator-packets.jsonl"}}) {
      std::ifstream in("tests/data/" + std::string(file));
      std::string hex_lines, json_lines;
      std::vector<json> packets;
      for (std::string line; std::getline(in, line);) {
        packets.push_back(json::parse(line));
        hex_lines += packets.back()["hex"].get<std::string>() + "\n";
      }
      REQUIRE(packets.size() > 90);
      const Result decoded = decode(hex_lines, *set);
      CHECK(decoded.exit_code == 0);
      CHECK(decoded.errors == "");
      REQUIRE(decoded.lines.size() == packets.size());
      for (std::size_t i = 0; i < packets.size(); ++i) {
        const json ours = json::parse(decoded.lines[i]);
        CHECK(ours["name"] == packets[i]["name"]);
        CHECK(ours["fields"] == packets[i]["fields"]);
        if (packets[i].contains("header")) CHECK(ours["header"] == packets[i]["header"]);
        CHECK(ours["crc_ok"] == true);
        CHECK(ours["hex"] == packets[i]["hex"]);
        json_lines += decoded.lines[i] + "\n";
      }
      const Result encoded = encode(json_lines, *set);
      CHECK(encoded.errors == "");
      std::string back;
      for (const std::string& line : encoded.lines) back += line + "\n";
      CHECK(back == hex_lines);
    }
  }

  TEST_CASE("a line without an end is not kept, and what is nested without an end is not followed") {
    const std::string endless((std::size_t{1} << 20) + 1, '0'), last = "\n42\n";
    const std::string wrong = "line 1: error: the line is longer than 1024 KiB; a packet has 64 at most\n";
    CHECK(decode(endless + endless + last).errors.starts_with(wrong + "line 2: error: "));
    CHECK(encode(endless + endless + last).errors.starts_with(wrong + "line 2: error: "));
    CHECK(decode(endless.substr(1) + last).errors.find("longer") == std::string::npos);
    const std::string deep = R"({"name":"Abort","fields":{"a":)" + std::string(1'000'000, '[');
    CHECK(encode(deep).errors == "line 1: error: the line is nested deeper than 64 levels\n");
    CHECK(encode(deep + "\n" + R"({"name":"Abort"})").lines.size() == 1);
  }

  TEST_CASE("an object of the listing's form") {
    CHECK(decode("ffff0f021f400070", javiator_set).lines ==
          std::vector<std::string>{R"({"name":"IDLE_LIMIT","header":{"sync":65535,"mgid":15,"size":2},)"
                                   R"("fields":{"idle":8000},"crc_ok":true,"hex":"ffff0f021f400070"})"});
  }

  TEST_CASE("the byte order is reported where it is not the set's own, and kept") {
    const Result big = encode(R"({"name":"Depth","order":"big","fields":{"value":1.5}})");
    REQUIRE(big.lines.size() == 1);
    CHECK(big.lines[0].substr(0, 12) == "fe5401090004");
    const Result decoded = decode(big.lines[0]);
    REQUIRE(decoded.lines.size() == 1);
    CHECK(json::parse(decoded.lines[0])["order"] == "big");
    CHECK(encode(decoded.lines[0]).lines == big.lines);
    CHECK(encode(R"({"name":"SWITCH_STATE","order":"little"})", javiator_set).errors ==
          "line 1: error: \"order\" is \"little\"; it needs \"big\"\n");
  }

  TEST_CASE("a bad line is named, and the rest goes on") {
    const std::string good = "ffff11000011";
    const Result result = decode(
        good + "\nffff1x\n\nffff1\n" + good + "\nffff17000017\nffff0f011f002f\n  " + good + "  \n", javiator_set);
    CHECK(result.exit_code == 2);
    CHECK(result.lines.size() == 3);
    CHECK(result.errors ==
          "line 2: error: column 6 is no hexadecimal digit; a packet is two of them a byte\n"
          "line 4: error: the packet has an odd number of hexadecimal digits; it needs two a byte\n"
          "line 6: error: message id 23 is not in set javiator\n"
          "line 7: error: field 'idle' of IDLE_LIMIT needs 2 bytes where 1 are left\n");
  }

  TEST_CASE("a packet with a wrong checksum is shown all the same, with a negative verdict") {
    const Result result = decode("ffff0f021f400071", javiator_set);
    CHECK(result.exit_code == 1);
    REQUIRE(result.lines.size() == 1);
    CHECK(json::parse(result.lines[0])["crc_ok"] == false);
    CHECK(json::parse(result.lines[0])["fields"]["idle"] == 8000);
  }

  TEST_CASE(
      "values outside the limits of the definition are reported beside the fields; the packet is good all the same") {
    const Result wild = encode(R"({"name":"SetThrusterActuation","fields":{"id":0,"value":1.5}})");
    REQUIRE(wild.lines.size() == 1);
    const Result decoded = decode(wild.lines[0]);
    CHECK(decoded.exit_code == 0);
    REQUIRE(decoded.lines.size() == 1);
    CHECK(json::parse(decoded.lines[0])["outside"] == json{"value: 1.5 is above 1"});
    CHECK(encode(decoded.lines[0]).lines == wild.lines);
    const Result tame = encode(R"({"name":"SetThrusterActuation","fields":{"id":0,"value":1}})");
    CHECK_FALSE(json::parse(decode(tame.lines.at(0)).lines.at(0)).contains("outside"));
  }

  TEST_CASE("what can't be encoded is said") {
    const auto error = [](const std::string& line) { return encode(line).errors; };
    CHECK(error("{") ==
          "line 1: error: the line is no JSON object; it needs {\"name\": ..., \"header\": ..., \"fields\": ...}\n");
    CHECK(error("{}") == "line 1: error: the packet has no \"name\"; it needs that of a message of set imc\n");
    CHECK(error(R"({"name":"Dept"})") == "line 1: error: set imc has no message 'Dept'; did you mean 'Depth'?\n");
    CHECK(error(R"({"name":"Depth","field":{}})") ==
          "line 1: error: the packet has a key 'field'; did you mean 'fields'?; it may have: name, header, fields, "
          "order, "
          "crc_ok, outside, hex\n");
    CHECK(error(R"({"name":"DesiredZ","fields":{"valu":1}})") ==
          "line 1: error: DesiredZ has no field 'valu'; did you mean 'value'?; it has: value, z_units\n");
    CHECK(error(R"({"name":"DesiredZ","fields":{"value":"deep"}})") ==
          "line 1: error: field 'value' of DesiredZ is \"deep\"; it needs a number, \"NaN\", \"Infinity\", "
          "\"-Infinity\", or "
          "bits as in \"0x7fc00001\"\n");
    CHECK(error(R"({"name":"DesiredZ","fields":{"value":1e39}})") ==
          "line 1: error: field 'value' of DesiredZ is 1e+39; it needs a number that the type can hold\n");
    CHECK(
        error(R"({"name":"DesiredZ","fields":{"z_units":256}})") ==
        "line 1: error: field 'z_units' of DesiredZ is 256; it needs an integer from 0 to 255, or one of: NONE, DEPTH, "
        "ALTITUDE, HEIGHT\n");
    CHECK(error(R"({"name":"DesiredZ","fields":[1]})") ==
          "line 1: error: the fields of DesiredZ are [1]; they need to be an object\n");
    CHECK(error(R"({"name":"Reference","fields":{"z":{"abbrev":"DesiredSpeed"}}})") ==
          "line 1: error: field 'z' of Reference holds DesiredSpeed, which is no DesiredZ\n");
    CHECK(error(R"({"name":"Reference","fields":{"z":{"abbrev":"DesiredY"}}})") ==
          "line 1: error: field 'z' of Reference holds 'DesiredY', which is no message of set imc; did you mean "
          "'DesiredZ'?\n");
    CHECK(error(R"({"name":"TransmissionRequest","fields":{"raw_data":"0"}})") ==
          "line 1: error: field 'raw_data' of TransmissionRequest is \"0\"; it needs two hexadecimal digits a byte\n");
    CHECK(encode(R"({"name":"JAVIATOR_DATA","fields":{"x_pos":12345678}})", javiator_set).errors ==
          "line 1: error: field 'x_pos' of JAVIATOR_DATA is 12345678; it needs an integer of at most 7 digits\n");
    CHECK(encode(R"({"name":"JAVIATOR_DATA_SHORT","fields":{"data":[1]}})", javiator_set).errors ==
          "line 1: error: field 'data' of JAVIATOR_DATA_SHORT is [1]; it needs a list of 30 numbers\n");
  }

  TEST_CASE("enumerators and bits may stand by their names") {
    const auto same = [](const std::string& a, const std::string& b) {
      CHECK(encode(a).lines == encode(b).lines);
      CHECK(encode(a).lines.size() == 1);
    };
    same(R"({"name":"DesiredZ","fields":{"z_units":"DEPTH"}})", R"({"name":"DesiredZ","fields":{"z_units":1}})");
    same(R"({"name":"ControlLoops","fields":{"mask":["DEPTH","NO_OVERRIDE"]}})",
         R"({"name":"ControlLoops","fields":{"mask":2147483656}})");
  }

  TEST_CASE("what is no number, no text or no digits comes back to the bit") {
    const auto there_and_back = [](const std::string& fields, const std::string& name,
                                   const messages::MessageSet& set) {
      const Result encoded = encode(R"({"name":")" + name + R"(","fields":)" + fields + "}", set);
      CHECK(encoded.errors == "");
      REQUIRE(encoded.lines.size() == 1);
      const Result decoded = decode(encoded.lines[0], set);
      REQUIRE(decoded.lines.size() == 1);
      CHECK(encode(decoded.lines[0], set).lines == encoded.lines);
      return json::parse(decoded.lines[0])["fields"];
    };
    for (const char* value : {"NaN", "Infinity", "-Infinity", "0x7fc00001"})
      CHECK(there_and_back(R"({"value":")" + std::string(value) + "\"}", "Depth", imc_set)["value"] == value);
    CHECK(there_and_back(R"({"value":"0xfff8000000000001"})", "DesiredHeading", imc_set)["value"] ==
          "0xfff8000000000001");
    CHECK(there_and_back(R"({"actions":{"hex":"ff00"}})", "RemoteActions", imc_set)["actions"]["hex"] == "ff00");
    CHECK(there_and_back(R"({"x_pos":{"hex":"3132333435363738"}})", "JAVIATOR_DATA", javiator_set)["x_pos"]["hex"] ==
          "3132333435363738");
  }
}

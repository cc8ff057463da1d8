// Every error in a definition, with its place and what would be right, word for word.
// In one file: a list of errors.
#include "tools/messages/definition.h"

#include <doctest/doctest.h>

#include "graph/language/yaml.h"
#include "tools/messages/write.h"

using namespace jarol;
using namespace jarol::definition;

namespace {

const std::string header =
    R"(<header><field abbrev="sync" type="uint16_t" value="0xFE54"/><field abbrev="mgid" type="uint16_t"/>)"
    R"(<field abbrev="size" type="uint16_t"/></header>)";
const std::string footer = R"(<footer><field abbrev="crc16" type="uint16_t"/></footer>)";
const std::string one = R"(<message id="1" abbrev="One"><field abbrev="a" type="uint8_t"/></message>)";

Definition read(const std::string& text) { return read_definition(Source{"t.xml", text}); }

// The first line of each error in the text, without its place where that is the same for all.
std::string report_on(const std::string& text) {
  try {
    const Definition definition = read(text);
    write_header(definition, "t");
    write_tables(definition, "t");
    return "";
  } catch (const SpecError& error) {
    std::string report;
    for (const Problem& problem : error.problems())
      report += (report.empty() ? "" : "\n") + to_text(problem).substr(0, to_text(problem).find('\n'));
    return report;
  }
}

// Of a definition whose messages, from the second line on, are these.
std::string report_on_messages(const std::string& messages, const std::string& before = "",
                               const std::string& attributes = "") {
  return report_on("<messages name=\"T\"" + attributes + ">" + before + header + footer + "\n" + messages +
                   "\n</messages>");
}

// Of a field, with the attributes and children given.
std::string report_on_field(const std::string& attributes, const std::string& children = "") {
  return report_on_messages("<message id=\"1\" abbrev=\"One\">\n<field abbrev=\"a\" " + attributes + ">" + children +
                            "</field></message>");
}

}  // namespace

TEST_SUITE("tools/messages/definition") {
  TEST_CASE("a definition is read") {
    const Definition d = read("<messages name=\"T\">" + header + footer + one + "</messages>");
    CHECK(d.title == "T");
    CHECK(d.checksum == "crc16_ibm");
    CHECK(d.max_payload == 65535 - 6 - 2);
    REQUIRE(d.messages.size() == 1);
    CHECK(d.messages[0].wire_size == 1);
  }

  TEST_CASE("what the public definition has beside messages is passed over") {
    const std::string text = R"(<?xml version="1.0" encoding="UTF-8"?>
<!-- a comment -->
<messages xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:noNamespaceSchemaLocation="IMC.xsd" name="T"
          long-name="Test" version="5.3.x" creation="2020" revision="r1">
  <description>What it is.</description>
  <types><description>All.</description><type name="int8_t" size="1"><description>Small.</description></type></types>
  <serialization><type name="rawdata"><description>With a count.</description></type></serialization>
  <units><unit abbrev="°C" name="Degree"/><unit abbrev="TupleList" name="Tuples"><description>=</description></unit></units>
  <enumerations><def name="Type" abbrev="Type" prefix="T"><value id="0" name="Sensor" abbrev="SENSOR" note="old"/></def></enumerations>
  <bitfields><def prefix="L" name="Loops" abbrev="Loops"><value id="0xFFFFFFFF" abbrev="ALL" name="All"/></def></bitfields>
  <message-groups><message-group name="Some" abbrev="Some"><message-type abbrev="A"/></message-group></message-groups>
  <flags><flag abbrev="deprecated" name="Deprecated"/></flags>
)" + header + footer + R"(
  <groups><group name="Core" abbrev="GroupCore" min="0" max="49"/></groups>
  <categories><category name="Core"/></categories>
  <message id="1" name="A of A" abbrev="A" category="Core" source="vehicle,ccu" flags="deprecated" stable="false"
           used-by="ccu" deprecated="true">
    <field name="Type" abbrev="type" type="uint8_t" unit="Enumerated" enum-def="Type" bitfield-def="" message-type=""/>
    <field name="Loops" abbrev="loops" type="uint32_t" unit="Bitfield" bitfield-def="Loops" note="a mask"/>
    <field name="Own" abbrev="own" type="int8_t" prefix="O" min="-23" max="23" value="-1">
      <description/>
      <value id="-1" name="Less" abbrev="LESS"><description>Less.</description></value>
      <value id="0x01" name="More" abbrev="MORE"></value>
    </field>
    <field name="Any" abbrev="message" type="message"/>
    <field name="Some" abbrev="message_id" type="message-list" message-type="Some"/>
  </message>
  <message id="2" name="No field" abbrev="B" category="Core"/>
</messages>)";
    CHECK(report_on(text) == "");
    const Definition d = read(text);
    REQUIRE(d.messages.size() == 2);
    CHECK(d.messages[0].fields[0].values.size() == 1);
    CHECK(d.messages[0].fields[1].bits);
    CHECK(d.messages[0].fields[2].values[0].value == -1);
    CHECK(d.messages[0].fields[4].ids == std::vector<std::uint32_t>{1});
  }

  TEST_CASE("the byte order may be spelt as the schema of the public definition spells it") {
    const auto order = [](const std::string& spelt) {
      return read("<messages name=\"T\" byte-order=\"" + spelt + "\">" + header + footer + one + "</messages>").order;
    };
    CHECK(order("LITTLE_ENDIAN") == "little");
    CHECK(order("BIG_ENDIAN") == "big");
  }

  TEST_CASE("an error shows the line with a caret") {
    CHECK_THROWS_WITH_AS(read("<messages name=\"T\">" + header + footer + "\n  <message abbrev=\"One\"/>\n</messages>"),
                         "t.xml:2:4: error: message 'One' has no 'id'; it needs one\n"
                         "    <message abbrev=\"One\"/>\n"
                         "     ^",
                         SpecError);
  }

  TEST_CASE("what is no definition") {
    CHECK(report_on("") ==
          "t.xml:1:1: error: the XML can't be read: no document element found; a definition is one "
          "element <messages>");
    CHECK(report_on("<messages>\n<message></messages>") ==
          "t.xml:2:12: error: the XML can't be read: start-end tags mismatch; a definition is one element <messages>");
    CHECK(report_on("<message/>") == "t.xml:1:2: error: the definition is an element <message>; it needs <messages>");
    CHECK(report_on("<messages>" + header + one + "</messages>") ==
          "t.xml:1:2: error: the definition has no 'name'; it needs one");
    CHECK(report_on_messages("") == "t.xml:1:2: error: the definition has no <message>; it needs one at least");
    CHECK(
        report_on_messages(one, "<mesage/>") ==
        "t.xml:1:21: error: the definition has an element <mesage>; did you mean 'message'?; it may have: description, "
        "types, serialization, units, enumerations, bitfields, message-groups, flags, header, footer, groups, "
        "categories, message");
    CHECK(report_on_messages(one, "", " checksum=\"crc32\"") ==
          "t.xml:1:2: error: the definition has the checksum 'crc32'; it may be: crc16_ibm, sum16");
    CHECK(report_on_messages(one, "", " byteorder=\"big\"") ==
          "t.xml:1:2: error: the definition has the attribute 'byteorder'; did you mean 'byte-order'?; it may have: "
          "name, "
          "long-name, version, creation, revision, byte-order, checksum, checksum-from, most-bytes");
    CHECK(report_on_messages(one, "", " checksum-from=\"6\"") ==
          "t.xml:1:2: error: the definition has the checksum-from 6; it needs to be within the header of 6 bytes");
    CHECK(report_on_messages(one, "", " most-bytes=\"8\"") ==
          "t.xml:1:2: error: the definition has the most-bytes 8; header and checksum alone take 8");
    CHECK(report_on_messages(one, "", " most-bytes=\"many\"") ==
          "t.xml:1:2: error: the definition has the most-bytes 'many'; it needs an integer from 1 to 65535");
  }

  TEST_CASE("what is wrong with header or footer") {
    const auto report = [](const std::string& fields, const std::string& attributes = "") {
      return report_on("<messages name=\"T\"" + attributes + ">\n<header>" + fields + "</header>" + one +
                       "</messages>");
    };
    const std::string sync = R"(<field abbrev="sync" type="uint16_t" value="0xFE54"/>)",
                      id = R"(<field abbrev="mgid" type="uint16_t"/>)",
                      size = R"(<field abbrev="size" type="uint8_t"/>)";
    CHECK(report(sync + id) ==
          "t.xml:2:2: error: the header has no field 'size'; it needs sync (first), mgid and size");
    CHECK(report(id + sync + size) == "t.xml:2:48: error: the header's field 'sync' is not its first; it needs to be");
    CHECK(report(sync + R"(<field abbrev="mgid" type="fp32_t"/>)" + size) ==
          "t.xml:2:63: error: the header's field 'mgid' is of type fp32_t; it needs uint8_t, uint16_t or uint32_t");
    CHECK(report(sync + id + size + R"(<field abbrev="x" type="plaintext"/>)") ==
          "t.xml:2:138: error: the header's field 'x' is of type plaintext; it needs a number");
    CHECK(report(R"(<field abbrev="sync" type="uint16_t"/>)" + id + size) ==
          "t.xml:2:10: error: the header's field 'sync' has no 'value'; it needs one");
    CHECK(
        report(R"(<field abbrev="sync" type="uint16_t" value="0x1FE54"/>)" + id + size) ==
        "t.xml:2:10: error: the header's field 'sync' has the value '0x1FE54'; it needs an integer that fits uint16_t");
    CHECK(report(R"(<field abbrev="sync" type="uint16_t" value="0xFFFF"/>)" + id + size) ==
          "t.xml:2:10: error: the sync 0xFFFF is the same in both byte orders; the definition needs a byte-order, "
          "little or "
          "big");
    CHECK(report(R"(<field abbrev="sync" type="uint16_t" value="0xFFFF"/>)" + id + size, " byte-order=\"big\"") == "");
    CHECK(report_on("<messages name=\"T\">" + header + "\n<footer><field abbrev=\"c\" type=\"uint32_t\"/></footer>" +
                    one + "</messages>") ==
          "t.xml:2:10: error: the footer has more than a checksum; it needs one field of type uint16_t, or none");
  }

  TEST_CASE("what is wrong with a message") {
    CHECK(report_on_messages(R"(<message id="65535" abbrev="A"/>)") ==
          "t.xml:2:2: error: message 'A' has the id 65535; it needs one below 65535");
    CHECK(report_on_messages(R"(<message id="x" abbrev="A"/>)") ==
          "t.xml:2:2: error: message 'A' has the id 'x'; it needs an integer from 0 to 4294967295");
    CHECK(report_on_messages(one + "\n" + R"(<message id="2" abbrev="One"/>)") ==
          "t.xml:3:2: error: message 'One' is defined twice; a name stands for one message");
    CHECK(
        report_on_messages(one + "\n" +
                           R"(<message id="1" abbrev="Two"><field abbrev="b" type="int8_t"/></message>)") ==
        "t.xml:3:2: error: message 'Two' has the id 1 of 'One'; only messages of different fixed sizes may share one");
    CHECK(report_on_messages(R"(<message id="1" abbrev="A" strukt="B"/>)") ==
          "t.xml:2:2: error: message 'A' has the attribute 'strukt'; did you mean 'struct'?; it may have: id, name, "
          "abbrev, "
          "struct, category, source, flags, stable, used-by, deprecated");
    CHECK(report_on_messages(R"(<message id="1" abbrev="A"><feild abbrev="a" type="int8_t"/></message>)") ==
          "t.xml:2:29: error: message 'A' has an element <feild>; did you mean 'field'?; it may have: description, "
          "field, "
          "part");
    CHECK(
        report_on_messages(
            R"(<message id="1" abbrev="A"><field abbrev="a" type="int8_t"/><field abbrev="a" type="int8_t"/></message>)") ==
        "t.xml:2:62: error: message 'A' has the field 'a' twice; each needs a name of its own");
    CHECK(report_on_messages(
              R"(<message id="1" abbrev="A"><field abbrev="a" type="uint8_t" count="65535"/></message>)") ==
          "t.xml:2:2: error: message 'A' has 65535 bytes; at most 65527 fit into a packet");
  }

  TEST_CASE("what is wrong with a field") {
    CHECK(
        report_on_field("type=\"uint9_t\"") ==
        "t.xml:3:2: error: message 'One' field 'a' has the type 'uint9_t'; did you mean 'uint8_t'?; it may be: int8_t, "
        "uint8_t, int16_t, uint16_t, int32_t, uint32_t, int64_t, uint64_t, fp32_t, fp64_t, plaintext, rawdata, rest, "
        "message, message-list");
    CHECK(report_on_field("") == "t.xml:3:2: error: message 'One' field 'a' has no 'type'; it needs one");
    CHECK(
        report_on_field("type=\"int8_t\" units=\"m\"") ==
        "t.xml:3:2: error: message 'One' field 'a' has the attribute 'units'; did you mean 'unit'?; it may have: name, "
        "abbrev, type, unit, min, max, prefix, enum-def, bitfield-def, message-type, value, note, fixed, count");
    CHECK(report_on_field("type=\"plaintext\" count=\"3\"") ==
          "t.xml:3:2: error: message 'One' field 'a' is an array of plaintext; only numbers have a 'count'");
    CHECK(report_on_field("type=\"uint8_t\" count=\"0\"") ==
          "t.xml:3:2: error: message 'One' field 'a' has the count '0'; it needs an integer from 1 to 65535");
    CHECK(report_on_field("type=\"uint8_t\" message-type=\"One\"") ==
          "t.xml:3:2: error: message 'One' field 'a' of type uint8_t has a message-type; only message and message-list "
          "may");
    CHECK(report_on_field("type=\"message\" message-type=\"On\"") ==
          "t.xml:3:2: error: message 'One' field 'a' names 'On', which is no message or group; did you mean 'One'?");
    CHECK(report_on_field("type=\"uint8_t\" enum-def=\"Colour\"") ==
          "t.xml:3:2: error: message 'One' field 'a' has the enum-def 'Colour', which is not defined; there are: "
          "nothing");
    CHECK(report_on_field("type=\"uint8_t\"", "<value id=\"1.5\" abbrev=\"A\"/>") ==
          "t.xml:3:35: error: a value of message 'One' field 'a' has the id '1.5'; it needs an integer from "
          "-2147483648 to "
          "4294967295");
    CHECK(
        report_on_field("type=\"int8_t\" value=\"128\"") ==
        "t.xml:3:2: error: message 'One' field 'a' of type int8_t has the default '128'; it needs an integer that fits "
        "int8_t");
    CHECK(report_on_field("type=\"int8_t\" value=\"-128\"") == "");
    CHECK(report_on_field("type=\"uint8_t\" value=\"RED\"", "<value id=\"1\" abbrev=\"BLUE\"/>") ==
          "t.xml:3:2: error: message 'One' field 'a' of type uint8_t has the default 'RED'; it needs an integer that "
          "fits "
          "uint8_t, or one of: BLUE");
    CHECK(report_on_field("type=\"fp32_t\" value=\"deep\"") ==
          "t.xml:3:2: error: message 'One' field 'a' of type fp32_t has the default 'deep'; it needs a number");
    CHECK(report_on_field("type=\"rawdata\" value=\"00\"") ==
          "t.xml:3:2: error: message 'One' field 'a' of type rawdata has the default '00'; it needs none, which only "
          "texts "
          "and single numbers have");
  }

  TEST_CASE("what is wrong with parts, rests and groups") {
    CHECK(report_on_messages(R"(<message id="1" abbrev="A"><part abbrev="p" message-type="B"/></message>)") ==
          "t.xml:2:29: error: message 'A' field 'p' names 'B', which is no message");
    CHECK(report_on_messages(R"(<message id="1" abbrev="A"><part abbrev="p" message-type="A"/></message>)") ==
          "t.xml:2:2: error: message 'A' is part of itself: A");
    CHECK(report_on_messages(one + R"(<message id="2" abbrev="A"><field abbrev="a" type="int8_t"/>)"
                                   "\n"
                                   R"(<part abbrev="p" message-type="One"/></message>)") ==
          "t.xml:3:2: error: message 'A' has the field 'a' twice; each needs a name of its own");
    CHECK(
        report_on_messages(
            R"(<message id="1" abbrev="A"><field abbrev="r" type="rest"/><field abbrev="a" type="int8_t"/></message>)") ==
        "t.xml:2:29: error: message 'A' field 'r' takes the rest of the packet; it needs to be the last");
    CHECK(report_on_messages(R"(<message id="1" abbrev="R"><field abbrev="r" type="rest"/></message>)"
                             "\n"
                             R"(<message id="2" abbrev="A"><part abbrev="p" message-type="R"/></message>)") ==
          "t.xml:3:29: error: message 'A' field 'p' is R, which ends only with its packet; a part has an end");
    const std::string group =
        R"(<message-groups><message-group abbrev="G"><message-type abbrev="Oen"/></message-group></message-groups>)";
    CHECK(report_on_messages(one, group) ==
          "t.xml:1:2: error: message group 'G' names 'Oen', which is no message; did you mean 'One'?");
    CHECK(
        report_on_messages(
            R"(<message id="1" abbrev="G"/>)",
            R"(<message-groups><message-group abbrev="G"><message-type abbrev="G"/></message-group></message-groups>)") ==
        "t.xml:1:2: error: message group 'G' has the name of a message; it needs one of its own");
  }

  TEST_CASE("a set is named by what can be a file and a namespace") {
    for (const char* good : {"imc", "set_2", "a"}) CHECK(is_set_name(good));
    for (const char* bad : {"", "Imc", "2nd", "_a", "a-b", "int", "detail"}) CHECK(!is_set_name(bad));
  }

  TEST_CASE("all errors are reported at once, in the order of their places") {
    CHECK(report_on_messages("<message abbrev=\"A\"/>\n<message id=\"2\"/>") ==
          "t.xml:2:2: error: message 'A' has no 'id'; it needs one\n"
          "t.xml:3:2: error: a message has no 'abbrev'; it needs one");
  }

  TEST_CASE("the definition that the README shows is one") {
    const std::string readme = read_source("specs/messages/README.md")->text;
    const std::size_t begin = readme.find("<messages"), end = readme.find("```", begin);
    REQUIRE(begin < end);
    CHECK(report_on(readme.substr(begin, end - begin)) == "");
    CHECK(read(readme.substr(begin, end - begin)).messages[0].wire_size == 5);
  }

  TEST_CASE("a definition of more than a hundred times what there is, is not read") {
    std::string deep;
    for (int i = 0; i < 500'001; ++i) deep += "<a>";
    CHECK(report_on(deep) ==
          "t.xml:1:1: error: the XML has more than 500000 elements and attributes; a definition has a few thousand");
    CHECK(report_on(std::string(500'001, '=')).find("more than 500000") != std::string::npos);
  }
}

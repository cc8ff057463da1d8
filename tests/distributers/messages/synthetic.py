"""Writes a definition of 350 messages to the file named: every feature that definitions have, and names that are hard."""
import random
import sys

random.seed(350)
numbers = ["int8_t", "uint8_t", "int16_t", "uint16_t", "int32_t", "uint32_t", "int64_t", "uint64_t", "fp32_t", "fp64_t"]
units = ["", "m", "rad/s", "°", "%", "Enumerated", "Bitfield", "List", "TupleList"]
hard_names = ["class", "default", "operator", "int", "id", "fields", "descriptor", "message_id", "NAN", "errno", "delete",
              "value", "xor", "std", "_under", "3d", "a-b", "union", "major", "payload"]
defaults = {"int8_t": "-128", "uint8_t": "0xFF", "int16_t": "-0x10", "uint16_t": "65535", "int32_t": "-2147483648",
            "uint32_t": "4294967295", "int64_t": "-1", "uint64_t": "18446744073709551615", "fp32_t": "NaN",
            "fp64_t": "-inf"}
count = 350
out = []


def values(indent, bits):
    ids = ["0x01", "0x02", "4", "0x80"] if bits else ["0", "1", "0x10", "-1", "7"]
    names = ["class", "EOF", "INFINITY", "PLAIN_NAME", "3D"]
    for number, name in zip(ids, names):
        out.append(f'{indent}<value id="{number}" name="{name} it is" abbrev="{name}"/>')


def field(index, kind, extra="", inner=None):
    name = hard_names[index] if index < len(hard_names) and random.random() < 0.5 else f"f{index}"
    unit = random.choice(units[:5])
    if kind in ("plaintext",):
        unit = random.choice(["", "List", "TupleList"])
    unit_text = f' unit="{unit}"' if unit and "unit=" not in extra else ""
    start = f'    <field name="Field &quot;{index}&quot;" abbrev="{name}" type="{kind}"{unit_text}{extra}'
    if inner is None and random.random() < 0.7:
        out.append(start + "/>")
        return
    out.append(start + ">")
    out.append("      <description>\n        Says \"what\" it is,\n        over lines: ??= \\ and more \\\n      </description>")
    if inner is not None:
        values("      ", inner)
    out.append("    </field>")


def any_field(index, number):
    choice = random.randrange(14)
    kind = random.choice(numbers)
    if choice == 0:
        field(index, "plaintext", ' value="k=&quot;v&quot;"' if number % 3 == 0 else "")
    elif choice == 1:
        field(index, "rawdata")
    elif choice == 2:
        field(index, "message", random.choice(["", ' message-type="Group"', ' message-type="Message001"']))
    elif choice == 3:
        field(index, "message-list", random.choice(["", ' message-type="Group"', ' message-type="Message002"']))
    elif choice == 4:
        field(index, "uint8_t", ' unit="Enumerated" enum-def="Shared"')
    elif choice == 5:
        field(index, "uint32_t", ' unit="Bitfield" bitfield-def="Mask"')
    elif choice == 6:
        field(index, "int16_t", ' unit="Enumerated" prefix="P"', inner=False)
    elif choice == 7:
        field(index, "uint16_t", ' unit="Bitfield" prefix="B" value="0x80"', inner=True)
    elif choice == 8:
        field(index, kind, f' count="{random.randrange(1, 9)}"')
    elif choice == 9:
        field(index, kind, f' value="{defaults[kind]}"')
    elif choice == 10:
        field(index, kind, ' min="-3.5" max="0x10" note="checked by nobody"')
    else:
        field(index, kind)


def message(number):
    name = f"Message{number:03}"
    out.append(f'  <message id="{2 * number}" name="Message {number}" abbrev="{name}" category="Test" source="all"'
               f'{" flags=" + chr(34) + "periodic" + chr(34) if number % 7 == 0 else ""} stable="{number % 2}"'
               f'{" used-by=" + chr(34) + "nobody" + chr(34) if number % 11 == 0 else ""}>')
    out.append(f"    <description>\n      The message *{name}*.\n    </description>")
    if number in (1, 2):  # what others hold
        field(20, "fp64_t")
        field(21, "plaintext")
    elif number % 25 == 3:
        pass  # no field at all
    elif number % 25 == 4:
        out.append('    <part abbrev="first" message-type="Message001"/>')
        out.append('    <part abbrev="second" message-type="Flat"/>')
    else:
        for index in range(random.randrange(1, 20)):
            any_field(index, number)
    if number % 50 == 49:
        field(99, "rest")
    out.append("  </message>")


out.append('<?xml version="1.0" encoding="UTF-8"?>')
out.append('<messages name="Synthetic" long-name="Everything a definition can have" version="1.2.x">')
out.append("  <description>What is tested.</description>\n  <types>")
for kind in numbers + ["plaintext", "rawdata", "message", "message-list"]:
    out.append(f'    <type name="{kind}" size="1"/>')
out.append('  </types>\n  <serialization><type name="rawdata"/></serialization>\n  <units>')
for unit in units[1:]:
    out.append(f'    <unit name="{unit}" abbrev="{unit}"/>')
out.append('  </units>\n  <enumerations>\n    <def name="Shared Values" abbrev="Shared" prefix="S">')
values("      ", False)
out.append('    </def>\n  </enumerations>\n  <bitfields>\n    <def name="Shared Bits" abbrev="Mask" prefix="M">')
values("      ", True)
out.append('      <value id="0xFFFFFFFF" name="All" abbrev="ALL"/>\n    </def>\n  </bitfields>\n  <message-groups>')
out.append('    <message-group name="Group" abbrev="Group">\n      <message-type abbrev="Message001"/>')
out.append('      <message-type abbrev="Message005"/>\n      <message-type abbrev="Flat"/>\n    </message-group>\n  </message-groups>')
out.append('  <flags>\n    <flag name="Periodic" abbrev="periodic"/>\n  </flags>\n  <header>\n    <description>First.</description>')
out.append('    <field name="Sync" abbrev="sync" type="uint16_t" value="0xABCD" fixed="true"/>')
out.append('    <field name="Id" abbrev="mgid" type="uint16_t"/>\n    <field name="Size" abbrev="size" type="uint16_t"/>')
out.append('    <field name="Time" abbrev="timestamp" type="fp64_t" unit="s"/>\n  </header>\n  <footer>')
out.append('    <field name="Check" abbrev="crc16" type="uint16_t"/>\n  </footer>\n  <categories>\n    <category name="Test"/>\n  </categories>')
for number in range(1, count - 2):
    message(number)
out.append('  <message id="9000" name="Flat" abbrev="Flat" struct="VeryFlat">\n    <field name="g1" abbrev="g1" type="fp32_t"/>\n'
           '    <field name="digits" abbrev="g2" type="uint8_t" count="5" unit="Digits"/>\n  </message>')
out.append('  <message id="9001" name="Short" abbrev="SharedShort">\n    <field name="a" abbrev="a" type="uint8_t"/>\n  </message>')
out.append('  <message id="9001" name="Long" abbrev="SharedLong">\n    <field name="a" abbrev="a" type="uint64_t"/>\n  </message>')
out.append("</messages>")
assert sum(line.startswith("  <message id=") for line in out) == count
with open(sys.argv[1], "w", encoding="utf-8") as file:
    file.write("\n".join(out) + "\n")

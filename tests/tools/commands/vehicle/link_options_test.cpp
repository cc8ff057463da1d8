// The options of `jarol vehicle` for a link are the keys of the link types that are registered.
#include "tools/commands/vehicle/link_options.h"

#include <doctest/doctest.h>

#include "distributers/links/packet_link.h"
#include "tools/library/built_in.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;

struct RadioSpec : PacketLinkSpec {
  Maybe<std::int64_t> frequency;
  Maybe<Yaml> antenna;
};

LinkType radio() {
  return packet_link<RadioSpec>(
      "radio", "a modem", {},
      {key<&RadioSpec::frequency>("frequency", Form::integer, "in MHz", true),
       key<&RadioSpec::antenna>("antenna", Form::mapping, "where it is")},
      [](const RadioSpec&, const Yaml&, const std::string&, Problems&) { return std::unique_ptr<Transport>(); });
}

std::string text_of(const std::vector<tools::LinkOption>& options) {
  std::string text;
  for (const tools::LinkOption& option : options) text += "--" + option.key + "  " + option.text + "\n";
  return text;
}
}  // namespace

TEST_SUITE("tools/link_options") {
  TEST_CASE("each key that a word can give is an option, with the types that have it") {
    NamedList<LinkType> types;
    types.add(radio());
    LinkType other = radio();
    other.name = "laser";
    other.keys[1].text = "in THz";
    types.add(other);
    CHECK(text_of(tools::link_options(types)) ==
          "--frequency  Link radio: in MHz; laser: in THz\n"
          "--id  Link radio, laser: the sender's id in what is sent, as in 0x00D1; packets to another id are dropped\n"
          "--source  Link radio, laser: the sender's id in what counts, as in 0x00D1; default: any\n");
  }

  TEST_CASE("a type that carries no packets in real time adds none") {
    NamedList<LinkType> types;
    LinkType type = radio();
    type.make_link = nullptr;
    types.add(type);
    CHECK(text_of(tools::link_options(types)) == "");
  }

  TEST_CASE("the built-in links have theirs") {
    std::string names;
    for (const tools::LinkOption& option : tools::link_options(built_in().links)) names += option.key + " ";
    CHECK(names == "listen peer peers announce silence key id source device baud ");
  }
}

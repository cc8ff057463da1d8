// What a program outside the tree adds to the registries works as what is built in does.
#include "distributers/registries.h"

#include <doctest/doctest.h>

#include "distributers/distributers.h"
#include "distributers/links/packet_link.h"
#include "tests/graph/graph_of.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;

// A way to nobody, by a number.
class Radio : public Transport {
 public:
  explicit Radio(std::int64_t frequency) : frequency_(frequency) {}
  std::string text() const override { return "radio at " + std::to_string(frequency_) + " MHz"; }
  void open() override {}
  void receive(const Interrupter& interrupter, ByteSink&) override {
    while (interrupter.wait(-1, std::chrono::milliseconds(-1)) != Interrupter::Woken::interrupted) {}
  }
  bool send(std::span<const std::byte>) override { return true; }
  void close() override {}

 private:
  std::int64_t frequency_;
};

struct RadioSpec : PacketLinkSpec {
  Maybe<std::int64_t> frequency;
};

std::unique_ptr<Transport> make_radio(const RadioSpec& spec, const Yaml&, const std::string&, Problems&) {
  return std::make_unique<Radio>(spec.frequency->value);
}

const Registries& known() {
  static const Registries all = [] {
    Registries made;
    tasks::add_tasks(made.graph);
    add_distributers(made.graph);
    add_links(made.links);
    made.links.add(packet_link<RadioSpec>(
        "radio", "a modem", {},
        {key<&RadioSpec::frequency>("frequency", Form::integer, "in MHz", true).in_range(400, 500)}, make_radio));
    return made;
  }();
  return all;
}

std::string text_of(const std::string& link) {
  return "graph: g\ntiming: {period: 10ms}\ndistributers: {pilot: {type: JaviatorOperator, link: " + link + "}}\n";
}

std::string report_on(const std::string& link) {
  Problems problems;
  const Graph graph = tests::graph_of(known().graph, text_of(link));
  make_channels(graph, known(), 0, problems);
  try {
    problems.throw_if_any();
  } catch (const SpecError& error) {
    const std::string text = error.what();
    return text.substr(text.find("error: "), text.find('\n') - text.find("error: "));
  }
  return "";
}
}  // namespace

TEST_SUITE("distributers/registries") {
  TEST_CASE("a link type of another's is named, checked and made as those that are built in") {
    Problems problems;
    const Graph graph = tests::graph_of(known().graph, text_of("{type: radio, frequency: 433}"));
    const auto channels = make_channels(graph, known(), 0, problems);
    problems.throw_if_any();
    REQUIRE(channels.size() == 1);
    CHECK(channels[0]->link_report()->link == "radio at 433 MHz");
    CHECK(channels[0]->needs_real_clock());
  }

  TEST_CASE("what is wrong with its keys is reported as with those that are built in") {
    CHECK(report_on("{type: radio, frequency: 433, frequenzy: 433}") ==
          "error: link of distributer 'pilot' has no key 'frequenzy'; did you mean 'frequency'?; it has: "
          "type, frequency, id, source, port");
    CHECK(report_on("{type: radio, frequency: 868}") ==
          "error: link of distributer 'pilot' key 'frequency': '868' is not from 400 to 500");
    CHECK(report_on("{type: radi, frequency: 433}") ==
          "error: link of distributer 'pilot' has type 'radi'; did you mean 'radio'?; a JaviatorOperator can "
          "have: script, udp, tcp_client, tcp_server, serial, radio");
  }

  TEST_CASE("a second entry of one name is refused") {
    Registries more = known();
    CHECK_THROWS_WITH_AS(more.links.add(*known().links.find("udp")), "there is a 'udp' already; names are unique",
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS(add_distributers(more.graph), "there is a 'JaviatorVehicle' already; names are unique",
                         std::invalid_argument);
  }
}

// What a program outside the tree adds to the registries works as what is built in does.
#include "distributers/registries.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "distributers/distributers.h"
#include "distributers/interfaces/typed.h"
#include "distributers/interfaces/vehicle_class.h"
#include "distributers/links/packet_link.h"
#include "distributers/messages/javiator.h"
#include "graph/analysis/policies.h"
#include "graph/text/errors.h"
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

// What is heard of a buoy: its depth. What it is sent: how far to sink.
struct Probe {
  static constexpr std::string_view summary = "a buoy";
  static constexpr bool is_vehicle = true;
  struct In {
    Newest<double> depth;
    static constexpr auto fields() { return describe(channel<&In::depth>("below the surface")); }
  };
  struct Out {
    double goal = 0;
    static constexpr auto fields() { return describe(channel<&Out::goal>("how deep it shall be")); }
  };
  static const messages::MessageSet& message_set() { return messages::javiator::message_set(); }
  static constexpr auto handlers() {
    return handle(on<messages::javiator::IdleLimit>(&Probe::hear), send<&Out::goal>(&Probe::sink));
  }
  void hear(const messages::javiator::IdleLimit& m) { in.depth = m.idle; }
  void sink(double goal, messages::Receiver& system) {
    messages::javiator::IdleLimit m;
    m.idle = static_cast<decltype(m.idle)>(goal);
    system.receive(messages::refer_to(m));
  }
  In in;
};

struct Metres {
  double value = 0;
  static constexpr auto fields() { return describe(field<&Metres::value>("m", "below the surface")); }
  static std::vector<vehicles::Range> ranges() { return {{0, 100}}; }
};
struct Groups {
  Metres depth;
  static constexpr auto fields() { return describe(field<&Groups::depth>()); }
};

// Each step takes it by its speed towards what it was sent.
class Buoy : public vehicles::Vehicle {
 public:
  using Parameters = Metres;  // of a step
  using Inputs = Metres;
  using Outputs = Groups;
  using Truth = Metres;
  Buoy(const Parameters& speed, std::uint64_t) : speed_(speed.value) {}
  Duration grid() const override { return std::chrono::milliseconds(5); }
  void accept(messages::MessageRef command) override {
    if (const auto* m = command.as<messages::javiator::IdleLimit>()) goal_ = m->idle;
  }
  void step() override { truth_.value += std::clamp(goal_ - truth_.value, -speed_, speed_); }
  void sense(messages::Receiver& receiver) const override {
    messages::javiator::IdleLimit m;
    m.idle = static_cast<decltype(m.idle)>(truth_.value);
    receiver.receive(messages::refer_to(m));
  }
  const Type* true_type() const override { return &type_of<Truth>(); }
  const void* true_values() const override { return &truth_; }
  vehicles::VehicleState state() const override { return {}; }
  void place(const vehicles::VehicleState&) override {}
  void command(const void* inputs) override { goal_ = static_cast<const Inputs*>(inputs)->value; }
  const void* outputs() const override { return &outputs_; }

 private:
  double speed_, goal_ = 0;
  Truth truth_;
  Outputs outputs_;
};

const Registries& known() {
  static const Registries all = [] {
    Registries made;
    analysis::add_policies(made.graph);
    tasks::add_tasks(made.graph);
    add_distributers(made.graph);
    add_links(made.links);
    made.links.add(packet_link<RadioSpec>(
        "radio", "a modem", {},
        {key<&RadioSpec::frequency>("frequency", Form::integer, "in MHz", true).in_range(400, 500)}, make_radio));
    made.graph.add(distributer_class<Probe>());
    made.vehicles.add(vehicles::vehicle_class<Buoy>("buoy", messages::javiator::message_set(), "goes up and down"));
    return made;
  }();
  return all;
}

std::string text_of(const std::string& link) {
  return "graph: g\ntiming: {period: 10ms}\ndistributers: {pilot: {type: JaviatorOperator, link: " + link + "}}\n";
}

// The link types that an operator can have, as a message lists them.
std::string links_of_operators() {
  std::vector<std::string> names;
  for (const LinkType& type : known().links.entries())
    if (!type.for_vehicles) names.push_back(type.name);
  return list_of(names);
}

std::string report_on(const std::string& link) {
  Problems problems;
  const Graph graph = tests::graph_of(known().graph, text_of(link));
  make_external_systems(graph, known(), 0, problems);
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
    const auto systems = make_external_systems(graph, known(), 0, problems);
    problems.throw_if_any();
    REQUIRE(systems.size() == 1);
    CHECK(systems[0]->link_report()->link == "radio at 433 MHz");
    CHECK(systems[0]->needs_real_clock());
  }

  TEST_CASE("what is wrong with its keys is reported as with those that are built in") {
    CHECK(report_on("{type: radio, frequency: 433, frequenzy: 433}") ==
          "error: link of distributer 'pilot' has no key 'frequenzy'; did you mean 'frequency'?; it has: "
          "type, frequency, id, source, port");
    CHECK(report_on("{type: radio, frequency: 868}") ==
          "error: link of distributer 'pilot' key 'frequency': '868' is not from 400 to 500");
    CHECK(report_on("{type: radi, frequency: 433}") ==
          "error: link of distributer 'pilot' has type 'radi'; did you mean 'radio'?; a JaviatorOperator can have: " +
              links_of_operators());
    CHECK(links_of_operators().find(", serial, ") != std::string::npos);
    CHECK(links_of_operators().ends_with(", radio"));
  }

  TEST_CASE("a vehicle and a distributer of another's are simulated by the link that is built in") {
    const auto path = std::filesystem::temp_directory_path() / ("buoy_" + std::to_string(getpid()) + ".yaml");
    std::ofstream(path) << "vehicle: buoy\nparameters: {value: 3}\n";
    Problems problems;
    const Graph graph = tests::graph_of(known().graph,
                                        "graph: g\ntiming: {period: 10ms}\n"
                                        "distributers: {sea: {type: Probe, link: {type: simulation, vehicle: " +
                                            path.string() + "}}}\n");
    const auto systems = make_external_systems(graph, known(), 0, problems);
    std::filesystem::remove(path);
    problems.throw_if_any();
    double depth = -1;
    const double goal = 10;
    systems[0]->reach(Duration{});
    CHECK(systems[0]->take(0, &depth));
    CHECK(depth == 0);
    systems[0]->hand_over(1, &goal);
    systems[0]->reach(std::chrono::milliseconds(10));
    CHECK(systems[0]->take(0, &depth));
    CHECK(depth == 6);
    CHECK_FALSE(systems[0]->take(0, &depth));
    systems[0]->reach(std::chrono::seconds(1));
    Metres truth;
    systems[0]->copy_true_values(&truth);
    CHECK(truth.value == 10);
  }

  TEST_CASE("a second entry of one name is refused") {
    Registries more = known();
    CHECK_THROWS_WITH_AS(more.links.add(*known().links.find("udp")), "there is a 'udp' already; names are unique",
                         InputError);
    CHECK_THROWS_WITH_AS(add_distributers(more.graph), "there is a 'JaviatorVehicle' already; names are unique",
                         InputError);
  }
}

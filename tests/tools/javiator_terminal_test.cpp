// The helicopter's graph and a control terminal of the JAviator: over real sockets, in logical time.
// In one file: all cases fly with one terminal.
#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <functional>
#include <iomanip>
#include <optional>
#include <sstream>
#include <thread>

#include "distributers/interfaces/typed.h"
#include "distributers/javiator/operator.h"
#include "distributers/links/linked.h"
#include "distributers/links/tcp.h"
#include "distributers/links/udp.h"
#include "runtime/execute/executor.h"
#include "tests/tools/process.h"
#include "tests/tools/terminal.h"
#include "tools/commands/run/load_graph.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
using namespace std::chrono_literals;
using tests::Terminal;

constexpr Duration period = 15ms;
constexpr int ground = 1, flying = 2, halted = 4;

bool listens_udp(int port) {
  std::ostringstream at;
  at << ":" << std::uppercase << std::hex << std::setfill('0') << std::setw(4) << port << " ";
  std::ifstream sockets("/proc/net/udp");
  return std::string(std::istreambuf_iterator<char>(sockets), {}).find(at.str()) != std::string::npos;
}

// The graph with a simulated vehicle; its operator is at the other end of a link. Each period waits for the terminal's
// answer, so that nothing depends on how busy the machine is.
class Lab {
 public:
  Lab(Terminal::Over over, const std::string& profile)
      : over_(over), loaded_(tools::load_graph("specs/javiator.yaml", {.profile = profile, .set = {}})) {
    const auto any = Address::parse("127.0.0.1:0");
    std::unique_ptr<Transport> transport;
    if (over == Terminal::Over::udp) {
      auto udp = std::make_unique<UdpTransport>(any, Address{});
      port_of_ = [at = udp.get()] { return at->port(); };
      transport = std::move(udp);
    } else {
      auto tcp = std::make_unique<TcpServer>(any);
      port_of_ = [at = tcp.get()] { return at->port(); };
      transport = std::move(tcp);
    }
    auto adapter = std::make_unique<Typed<JaviatorOperator>>();
    const auto& set = adapter->message_set();
    auto system = std::make_unique<LinkedSystem>(std::make_unique<Link>(std::move(transport), set, LinkOptions{}),
                                                 std::move(adapter));
    link_ = system.get();
    for (std::size_t i = 0; i < loaded_.systems.size(); ++i)
      if (loaded_.graph->distributers[i].name == "terminal") loaded_.systems[i] = std::move(system);
    executor_ = std::make_unique<Executor>(*loaded_.graph, std::move(loaded_.systems));
    link_->begin();
  }
  ~Lab() { link_->finish(); }

  // One that has been started, and has been heard of.
  Terminal connect() {
    Terminal terminal(port_of_(), over_);
    expected_ += terminal.sent;
    wait_for("packets in", expected_);
    wait_for("peers", ++peers_);
    return terminal;
  }

  // Ten periods without a terminal, and until the link knows that it is gone: another one is a stranger before.
  void miss(Terminal::Over over) {
    const std::string lost = over == Terminal::Over::udp ? "closed ports" : "ends of stream";
    const auto end = std::chrono::steady_clock::now() + 20s;
    for (int i = 0; i < 10 || count_of(lost) == 0; ++i) {
      REQUIRE(std::chrono::steady_clock::now() < end);
      // 35 periods are a lost operator, however long the link's thread has to wait for a processor
      if (i < 10 || i % 100 == 0) pass();
      if (i >= 10) std::this_thread::sleep_for(1ms);
    }
    std::this_thread::sleep_for(100ms);  // the next one is to see no half of a report and its trace
  }

  // One period, without an answer of anyone.
  void pass() {
    now_ += period;
    executor_->run_until(now_);
  }

  Terminal::Report pass(Terminal& terminal) {
    pass();
    const std::uint64_t before = terminal.sent;
    const auto report = terminal.answer();
    REQUIRE(report);
    arrived(terminal, before);
    reports.push_back(*report);
    return *report;
  }

  void press(Terminal& terminal, Terminal::Key key) {
    const std::uint64_t before = terminal.sent;
    terminal.press(key);
    arrived(terminal, before);
  }

  // Seconds of flight.
  Terminal::Report fly(Terminal& terminal, double seconds) {
    Terminal::Report last;
    for (int i = 0; i < seconds / 0.015; ++i) last = pass(terminal);
    return last;
  }

  // Raises or lowers the altitude as the key does while it is held, then waits.
  Terminal::Report go_to(Terminal& terminal, int altitude, double seconds) {
    while (terminal.needles.altitude != altitude) {
      const int away = altitude - terminal.needles.altitude;
      terminal.needles.altitude = static_cast<std::int16_t>(terminal.needles.altitude + std::clamp(away, -7, 7));
      pass(terminal);
    }
    return fly(terminal, seconds);
  }

  // Periods whose reports the terminal reads and does not answer; the last of them.
  Terminal::Report pass_unanswered(Terminal& terminal, int periods) {
    std::optional<Terminal::Report> report;
    for (int i = 0; i < periods; ++i) {
      pass();
      report = terminal.read();
      REQUIRE(report);
    }
    return *report;
  }

  // What the IMU says, whatever counts as level.
  double true_roll() const {
    const auto& all = loaded_.graph->communicators;
    const auto found = std::find_if(all.begin(), all.end(), [](const auto& c) { return c.name == "from_robostix"; });
    const void* value = executor_->last_value(static_cast<std::size_t>(found - all.begin()));
    return static_cast<const tasks::JaviatorSensors*>(value)->roll;
  }

  std::uint64_t faults() const { return executor_->report().fault_count; }

  std::vector<Terminal::Report> reports;

 private:
  void arrived(const Terminal& terminal, std::uint64_t before) {
    expected_ += terminal.sent - before;
    wait_for("packets in", expected_);
  }

  std::uint64_t count_of(const std::string& name) const {
    const LinkReport report = *link_->link_report();
    for (const auto& [counted, so_far] : report.counts)
      if (counted == name) return so_far;
    return 0;
  }

  void wait_for(const std::string& name, std::uint64_t min) {
    const auto end = std::chrono::steady_clock::now() + 20s;
    while (count_of(name) < min) {
      REQUIRE(std::chrono::steady_clock::now() < end);
      std::this_thread::sleep_for(20us);
    }
  }

  Terminal::Over over_;
  Loaded loaded_;
  std::function<int()> port_of_;
  LinkedSystem* link_ = nullptr;
  std::unique_ptr<Executor> executor_;
  Duration now_{};
  std::uint64_t expected_ = 0, peers_ = 0;
};

// From halt to the ground state and off, to 0.5 m.
Terminal::Report take_off(Lab& lab, Terminal& terminal, double wait) {
  lab.press(terminal, Terminal::switch_state);
  CHECK(lab.fly(terminal, 0.1).state == ground);
  lab.press(terminal, Terminal::switch_state);
  CHECK(lab.fly(terminal, 0.1).state == flying);
  lab.fly(terminal, 3);
  return lab.go_to(terminal, 500, wait);
}

void check_flight(Terminal::Over over, const std::string& profile, double settles) {
  Lab lab(over, profile);
  Terminal terminal = lab.connect();
  CHECK(lab.fly(terminal, 0.5).state == halted);  // a hello is no switch
  const Terminal::Report hovers = take_off(lab, terminal, settles);
  CHECK(hovers.z == doctest::Approx(500).scale(0).epsilon(0.05));
  CHECK(hovers.front > 6000);
  CHECK(hovers.mode == 1);
  terminal.needles.roll = 60;
  CHECK(lab.fly(terminal, 1).roll == doctest::Approx(60).scale(0).epsilon(0.3));
  terminal.needles.roll = 0;
  lab.fly(terminal, 1);
  lab.go_to(terminal, 0, 2);
  lab.press(terminal, Terminal::switch_state);
  const Terminal::Report landed = lab.fly(terminal, 4);
  CHECK(landed.state == ground);
  CHECK(std::abs(landed.z) <= 5);
  CHECK(landed.front == 0);
  lab.press(terminal, Terminal::shut_down);
  CHECK(lab.fly(terminal, 0.1).state == halted);
  CHECK(terminal.bad == 0);
  CHECK(lab.faults() == 0);
}
}  // namespace

TEST_SUITE("tools/javiator_terminal") {
  TEST_CASE("a terminal takes off, hovers, leans, lands and shuts down: over UDP with the laws of here") {
    check_flight(Terminal::Over::udp, "", 4);
  }
  TEST_CASE("a terminal takes off, hovers, leans, lands and shuts down: over TCP with the original laws") {
    check_flight(Terminal::Over::tcp, "original", 5);
  }

  TEST_CASE("on the real clock, the command serves a terminal") {
    const std::string port = tests::free_port(SOCK_DGRAM);
    tests::Process run(
        "run specs/javiator.yaml --clock real --force --for 1h --profile terminal "
        "--set distributers.terminal.link.listen=" +
        port);
    for (int look = 0; look < 4000 && !listens_udp(std::stoi(port)); ++look) std::this_thread::sleep_for(5ms);
    Terminal terminal(std::stoi(port), Terminal::Over::udp);
    std::vector<int> states;
    const auto answers_until = [&](int state) {
      for (int i = 0; i < 1000 && (states.empty() || states.back() != state); ++i) {
        const auto report = terminal.answer();
        if (!report) return;
        if (states.empty() || states.back() != report->state) states.push_back(report->state);
      }
    };
    answers_until(halted);
    terminal.press(Terminal::switch_state);
    answers_until(ground);
    terminal.press(Terminal::shut_down);
    answers_until(halted);
    run.interrupt();
    CHECK(run.end() == 130);
    CHECK(states == std::vector<int>{halted, ground, halted});
    CHECK(run.output().find("  link        udp 127.0.0.1:" + port + ": ") != std::string::npos);
    CHECK(terminal.bad == 0);
  }

  TEST_CASE("without commands the original laws stop the motors after more than 35 periods, and not before") {
    Lab lab(Terminal::Over::udp, "original");
    Terminal terminal = lab.connect();
    lab.fly(terminal, 0.1);
    REQUIRE(take_off(lab, terminal, 4).z > 400);
    // the last answer is heard in the first of them, the next one in the period after it
    SUBCASE("in time it flies on") {
      lab.pass_unanswered(terminal, 35);
      CHECK(lab.fly(terminal, 1).state == flying);
    }
    SUBCASE("too late") {
      // what is decided in the last shows in the next report
      CHECK(lab.pass_unanswered(terminal, 37).state == flying);
      CHECK(lab.pass_unanswered(terminal, 1).state == halted);
      CHECK(lab.pass_unanswered(terminal, 1).front == 0);
      CHECK(lab.fly(terminal, 1).state == halted);
    }
  }

  TEST_CASE("without commands the laws of here land") {
    Lab lab(Terminal::Over::udp, "");
    Terminal terminal = lab.connect();
    lab.fly(terminal, 0.1);
    REQUIRE(take_off(lab, terminal, 3).z > 450);
    CHECK(lab.pass_unanswered(terminal, 45).state == flying);
    const Terminal::Report landed = lab.pass_unanswered(terminal, 300);
    CHECK(landed.state == ground);
    CHECK(std::abs(landed.z) <= 5);
    // it comes back, and nothing has happened meanwhile
    CHECK(lab.fly(terminal, 0.2).state == ground);
  }

  TEST_CASE("a terminal that is started anew takes over in flight, and its hello does not land") {
    for (const auto over : {Terminal::Over::udp, Terminal::Over::tcp}) {
      Lab lab(over, "");
      std::optional<Terminal> terminal(lab.connect());
      lab.fly(*terminal, 0.1);
      REQUIRE(take_off(lab, *terminal, 3).z > 450);
      terminal.reset();
      lab.miss(over);
      terminal.emplace(lab.connect());
      terminal->needles.altitude = 500;
      const Terminal::Report again = lab.fly(*terminal, 2);
      CHECK(again.state == flying);
      CHECK(again.z == doctest::Approx(500).scale(0).epsilon(0.05));
      lab.press(*terminal, Terminal::switch_state);  // this one does
      CHECK(lab.fly(*terminal, 4).state == ground);
      CHECK(terminal->bad == 0);
    }
  }

  TEST_CASE("in position mode the first two needles are a place, y and x") {
    Lab lab(Terminal::Over::udp, "");
    Terminal terminal = lab.connect();
    lab.fly(terminal, 0.1);
    take_off(lab, terminal, 2);
    lab.press(terminal, Terminal::switch_mode);
    terminal.needles.roll = 300;
    terminal.needles.pitch = -200;
    const Terminal::Report there = lab.fly(terminal, 5);
    CHECK(there.mode == 2);
    CHECK(there.y == doctest::Approx(300).scale(0).epsilon(0.1));
    CHECK(there.x == doctest::Approx(-200).scale(0).epsilon(0.15));
  }

  TEST_CASE("a stored trim is the level from then on, until it is cleared") {
    for (const std::string profile : {"", "original"}) {
      Lab lab(Terminal::Over::udp, profile);
      Terminal terminal = lab.connect();
      lab.fly(terminal, 0.1);
      take_off(lab, terminal, 2);
      terminal.needles.roll = 40;
      const int leant = lab.fly(terminal, 0.8).roll;
      CHECK(leant > 25);
      lab.press(terminal, Terminal::store_trim);
      terminal.needles.roll = 0;
      lab.fly(terminal, 0.05);
      const double before = lab.true_roll();
      CHECK(before > 0.02);
      lab.fly(terminal, 0.6);
      CHECK(std::abs(lab.reports.back().roll) < 25);
      CHECK(lab.true_roll() == doctest::Approx(1e-3 * leant).scale(0).epsilon(0.4));
      lab.press(terminal, Terminal::clear_trim);
      lab.fly(terminal, 0.8);
      CHECK(std::abs(lab.reports.back().roll) < 25);
      CHECK(std::abs(lab.true_roll()) < 0.025);
    }
  }
}

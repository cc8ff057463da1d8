// What an original control terminal sent in a recorded flight, replayed against the graph with the original laws.
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "distributers/interfaces/typed.h"
#include "distributers/javiator/operator.h"
#include "distributers/messages/javiator.h"
#include "distributers/messages/packet.h"
#include "runtime/execute/executor.h"
#include "tests/distributers/messages/recorded.h"
#include "tests/tools/csv_rows.h"
#include "tools/commands/run/load_graph.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;
namespace javiator = messages::javiator;

// its hello came so long before a report
constexpr double hello = 66 * 0.015 + 0.010 - 0.0056;

struct Packet {
  double time = 0;
  messages::Message message;
};

// In the file a command that is the same as the one before is left out; there was one for each report.
std::vector<Packet> read_conversation() {
  std::vector<Packet> packets;
  std::ifstream file("tests/data/javiator-terminal.csv");
  std::string line;
  std::getline(file, line);
  messages::PacketReader reader(javiator::message_set());
  while (std::getline(file, line)) {
    const std::size_t comma = line.find(',');
    REQUIRE(reader.read(messages::bytes_of(line.substr(comma + 1))) == messages::PacketError::none);
    packets.push_back({hello + std::stod(line), messages::Message(reader.message())});
  }
  return packets;
}

struct Answer {
  double time = 0;
  messages::Message message;
};

// The terminal of the recording: what it sent comes at the time at which it did.
class Replay : public ExternalSystem, messages::Receiver {
 public:
  explicit Replay(std::vector<Answer>& answers) : packets_(read_conversation()), answers_(answers) {
    adapter_.peer_changed();
  }

  void reach(Duration instant) override {
    now_ = 1e-9 * static_cast<double>(instant.count());
    bool commanded = false;
    for (; next_ < packets_.size() && packets_[next_].time <= now_; ++next_) {
      adapter_.receive(packets_[next_].message);
      if (packets_[next_].message.as<javiator::CommandData>() == nullptr) continue;
      commanded = true;
      last_ = &packets_[next_].message;
    }
    if (reported_ && !commanded && last_ != nullptr) adapter_.receive(*last_);
    reported_ = false;
    adapter_.reach(instant, *this);
  }
  bool take(std::size_t channel, void* value) override { return adapter_.take(channel, value); }
  void hand_over(std::size_t channel, const void* value) override {
    adapter_.hand_over(channel, value, *this);
    reported_ = true;
  }

 private:
  void receive(messages::MessageRef message) override { answers_.push_back({now_, messages::Message(message)}); }

  distributers::Typed<distributers::JaviatorOperator> adapter_;
  std::vector<Packet> packets_;
  std::vector<Answer>& answers_;
  std::size_t next_ = 0;
  const messages::Message* last_ = nullptr;
  bool reported_ = false;
  double now_ = 0;
};

const std::vector<Answer>& answers() {
  static const std::vector<Answer> all = [] {
    std::vector<Answer> answers;
    auto loaded = tools::load_graph("specs/javiator.yaml", {.profile = "original", .set = {}});
    for (std::size_t i = 0; i < loaded.systems.size(); ++i)
      if (loaded.graph->distributers[i].name == "terminal") loaded.systems[i] = std::make_unique<Replay>(answers);
    Executor executor(*loaded.graph, std::move(loaded.systems));
    executor.run_until(46035ms);
    CHECK(executor.report().fault_count == 0);
    return answers;
  }();
  return all;
}
}  // namespace

TEST_SUITE("tools/javiator_conversation") {
  TEST_CASE("the recorded terminal gets a report and a trace each 15 ms, and nothing else") {
    const auto& all = answers();
    REQUIRE(all.size() == 2 * 46035 / 15);
    for (std::size_t i = 0; i < all.size(); i += 2) {
      CHECK(all[i].message.as<javiator::GroundReport>() != nullptr);
      CHECK(all[i + 1].message.as<javiator::TraceData>() != nullptr);
      CHECK(all[i].time == doctest::Approx(0.010 + 0.015 * static_cast<double>(i / 2)));
      CHECK(all[i + 1].time == all[i].time);
    }
  }

  TEST_CASE("its switches change the state as recorded, at most three periods later; its hello does not") {
    // seconds after the hello at which a report first reported the state
    const std::vector<std::pair<double, int>> recorded{{0, 4}, {3.5156, 1}, {5.5107, 2}, {39.5306, 1}, {43.5357, 4}};
    std::vector<std::pair<double, int>> reported;
    for (const Answer& a : answers())
      if (const auto* report = a.message.as<javiator::GroundReport>())
        if (reported.empty() || reported.back().second != report->state_mode.state)
          reported.emplace_back(a.time - hello, report->state_mode.state);
    REQUIRE(reported.size() == recorded.size());
    for (std::size_t i = 0; i < reported.size(); ++i) {
      CHECK(reported[i].second == recorded[i].second);
      if (i == 0) continue;
      CHECK(reported[i].first > recorded[i].first - 0.001);
      CHECK(reported[i].first < recorded[i].first + 0.046);
    }
  }

  TEST_CASE("it gets what the recorded one got: within 5 cm, 25 mrad of roll, 20 mrad of yaw") {
    double altitude = 0, roll = 0, yaw = 0;
    // the recorded flight's zero is 3.3506 s after the hello
    for (const auto& row : command::rows_of("tests/data/javiator-flight.csv")) {
      if (row[0] > 36.1) break;
      const auto at = static_cast<std::size_t>(std::lround((row[0] + 3.3506 + hello - 0.010) / 0.015));
      const auto* report = answers()[2 * at].message.as<javiator::GroundReport>();
      REQUIRE(report != nullptr);
      altitude = std::max(altitude, std::abs(1e-3 * report->sensors.z - row[1]));
      roll = std::max(roll, std::abs(1e-3 * report->sensors.roll - row[2]));
      yaw = std::max(yaw, std::abs(1e-3 * report->sensors.yaw - row[3]));
    }
    MESSAGE("apart at most " << altitude << " m, " << roll << " rad of roll, " << yaw << " rad of yaw");
    CHECK(altitude < 0.05);
    CHECK(roll < 0.025);
    CHECK(yaw < 0.02);
  }

  TEST_CASE("the signals rev up by 50 a period to 8000 and down again, as recorded") {
    int before = 0, steps_up = 0, steps_down = 0;
    for (const Answer& a : answers()) {
      const auto* report = a.message.as<javiator::GroundReport>();
      if (report == nullptr) continue;
      const double t = a.time - hello;
      if (t > 5.6 && t < 7.8 && report->signals.front - before == 50) ++steps_up;
      if (t > 39.6 && t < 41.6 && report->signals.front - before == -50) ++steps_down;
      before = report->signals.front;
    }
    CHECK(steps_up > 140);
    CHECK(steps_down > 130);
  }
}

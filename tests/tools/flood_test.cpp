// More valid packets than anyone can use: link and core go on, what is dropped is counted, and nothing grows.
#include <doctest/doctest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <thread>

#include "distributers/distributers.h"
#include "distributers/interfaces/typed.h"
#include "distributers/javiator/vehicle.h"
#include "distributers/links/linked.h"
#include "distributers/links/tcp.h"
#include "distributers/links/udp.h"
#include "distributers/messages/javiator.h"
#include "distributers/session/load.h"
#include "graph/analysis/policies.h"
#include "runtime/execute/executor.h"
#include "tasks/tasks.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
using namespace std::chrono_literals;
namespace javiator = messages::javiator;

constexpr Duration time_of_flood = 750ms;

std::size_t resident_bytes() {
  std::ifstream statm("/proc/self/statm");
  std::size_t size = 0, resident = 0;
  statm >> size >> resident;
  return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

// Sends what a vehicle's sensors report, as fast as it goes.
class Flood {
 public:
  explicit Flood(std::unique_ptr<Transport> transport)
      : link_(std::move(transport), javiator::message_set(),
              {.input = {}, .output = {PortKind::plain, 256}, .header = {}}) {
    link_.connect();
    thread_ = std::thread([this] {
      while (!ending_.load(std::memory_order_relaxed)) {
        for (int i = 0; i < 64; ++i) link_.send(messages::refer_to(javiator::JaviatorData{}));
        link_.flush();
      }
    });
  }
  ~Flood() { end(); }
  void end() {
    ending_ = true;
    if (thread_.joinable()) thread_.join();
    link_.disconnect();
  }
  LinkReport report() const { return link_.report(); }

 private:
  Link link_;
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

std::uint64_t count_of(const LinkReport& report, const std::string& name) {
  for (const auto& [counted, count] : report.counts)
    if (counted == name) return count;
  FAIL("no count of " << name);
  return 0;
}

// The helicopter's graph on the real clock; its vehicle is whatever comes over the link.
template <class MakeFlood>
void flood(std::unique_ptr<Transport> transport, const MakeFlood& make_flood, bool loses_nothing) {
  Registries known;
  analysis::add_policies(known.graph);
  tasks::add_tasks(known.graph);
  add_distributers(known.graph);
  add_links(known.links);
  Loaded loaded = load_graph(read_source("specs/javiator.yaml"), known,
                             {.profile = "", .set = {"distributers.robostix.link={type: udp, listen: 0}"}}, 0);
  const Graph& graph = *loaded.graph;
  auto adapter = std::make_unique<Typed<JaviatorVehicle>>();
  const auto& set = adapter->message_set();
  auto system = std::make_unique<LinkedSystem>(std::make_unique<Link>(std::move(transport), set, LinkOptions{}),
                                               std::move(adapter));
  LinkedSystem& link = *system;
  std::size_t robostix = 0, from_robostix = 0;
  for (std::size_t i = 0; i < graph.distributers.size(); ++i)
    if (graph.distributers[i].name == "robostix") robostix = i;
  for (std::size_t i = 0; i < graph.communicators.size(); ++i)
    if (graph.communicators[i].name == "from_robostix") from_robostix = i;
  loaded.systems[robostix] = std::move(system);
  RealClock clock(graph.tasks.size());
  Executor executor(graph, std::move(loaded.systems), {.clock = &clock});
  link.begin();
  auto source = make_flood();
  clock.start();
  executor.run_until(time_of_flood / 3);
  const std::size_t before = resident_bytes();
  executor.run_until(time_of_flood);
  const auto came_so_far = [&] { return count_of(*link.link_report(), "packets in"); };
  const auto overwritten_so_far = [&] { return count_of(*link.link_report(), "dropped: overwritten by newer"); };
  // longer on a machine so busy that there was no flood yet
  Duration end = time_of_flood;
  while ((came_so_far() <= 1000 || overwritten_so_far() == 0) && end < 60s) executor.run_until(end += time_of_flood);
  const std::size_t after = resident_bytes();
  source->end();
  // over TCP what was sent comes
  for (const auto patience = std::chrono::steady_clock::now() + 20s;
       loses_nothing && std::chrono::steady_clock::now() < patience &&
       came_so_far() < count_of(source->report(), "packets out");)
    std::this_thread::sleep_for(1ms);
  link.finish();
  // what is left in the port
  link.reach(end);
  tasks::JaviatorSensors sensors = *static_cast<const tasks::JaviatorSensors*>(executor.last_value(from_robostix));
  link.take(0, &sensors);

  const LinkReport in = *link.link_report(), out = source->report();
  const std::uint64_t came = count_of(in, "packets in"), overwritten = count_of(in, "dropped: overwritten by newer");
  MESSAGE(count_of(out, "packets out") << " sent, " << came << " came, " << overwritten << " dropped, "
                                       << sensors.answers << " taken by the graph; lateness 99 % "
                                       << clock.lateness().percentile(0.99).count() / 1000 << " us; memory grew by "
                                       << (after > before ? after - before : 0) << " bytes");
  CHECK(executor.report().instants == 2 * static_cast<std::uint64_t>(end / 15ms));
  CHECK_FALSE(executor.report().stopped);
  CHECK(came > 1000);
  CHECK(overwritten > 0);
  CHECK(came == overwritten + sensors.answers);
  if (loses_nothing) CHECK(came == count_of(out, "packets out"));
  if (!loses_nothing) CHECK(came <= count_of(out, "packets out"));
  CHECK(after < before + (std::size_t{4} << 20));
}
}  // namespace

TEST_SUITE("tools/flood") {
  TEST_CASE("a flood of valid packets is taken as it can be, the rest is counted, and the graph keeps its time: UDP") {
    auto transport = std::make_unique<UdpTransport>(Address::parse("127.0.0.1:0"), Address{});
    const UdpTransport& at = *transport;
    flood(
        std::move(transport),
        [&] {
          return std::make_unique<Flood>(std::make_unique<UdpTransport>(
              Address::parse("127.0.0.1:0"), Address::parse("127.0.0.1:" + std::to_string(at.port()))));
        },
        false);
  }

  TEST_CASE("a flood of valid packets is taken as it can be, the rest is counted, and the graph keeps its time: TCP") {
    auto transport = std::make_unique<TcpServer>(Address::parse("127.0.0.1:0"));
    const TcpServer& at = *transport;
    flood(
        std::move(transport),
        [&] {
          return std::make_unique<Flood>(
              std::make_unique<TcpClient>(Address::parse("127.0.0.1:" + std::to_string(at.port()))));
        },
        true);
  }
}

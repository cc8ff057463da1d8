// Who else holds a link's way to a vehicle learns when that steers itself.
#include <doctest/doctest.h>

#include <memory>
#include <utility>
#include <vector>

#include "distributers/interfaces/typed.h"
#include "distributers/lauv/vehicle.h"
#include "distributers/links/linked.h"
#include "distributers/links/udp.h"
#include "tests/distributers/links/open_link.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
using namespace std::chrono_literals;
namespace imc = messages::imc;

struct NotedHolder : Holder {
  void hold(int, const std::vector<Address>&) override {}
  void let_go() override {}
  bool set_steers_itself(bool steers_itself) override {
    said.push_back(steers_itself);
    return listens;
  }
  std::vector<bool> take() { return std::exchange(said, {}); }
  std::vector<bool> said;
  bool listens = true;
};

// A submarine on a link that nobody has connected, and what is reported to its holder.
struct HeldSubmarine {
  HeldSubmarine() {
    auto link = std::make_unique<Link>(std::make_unique<UdpTransport>(tests::any, Address{}), imc::message_set(),
                                       LinkOptions{});
    link->hold_by(&holder);
    auto made = std::make_unique<Typed<LauvVehicle>>();
    vehicle = made.get();
    system = std::make_unique<LinkedSystem>(std::move(link), std::move(made));
  }
  std::vector<bool> reported_at(Duration instant) {
    system->reach(instant);
    return holder.take();
  }
  void report_loops(std::uint32_t loops) {
    imc::VehicleState state;
    state.control_loops = loops;
    vehicle->receive(messages::refer_to(state));
  }

  NotedHolder holder;
  Typed<LauvVehicle>* vehicle = nullptr;
  std::unique_ptr<LinkedSystem> system;
};

using Reported = std::vector<bool>;
}  // namespace

TEST_SUITE("distributers/steers_itself") {
  TEST_CASE("it is reported once when a vehicle begins to steer itself, and once when it no longer does") {
    HeldSubmarine held;
    CHECK(held.reported_at(0s) == Reported{});
    held.report_loops(imc::CLoopsMask::DEPTH);
    CHECK(held.reported_at(1s) == Reported{true});
    held.report_loops(imc::CLoopsMask::DEPTH);
    CHECK(held.reported_at(2s) == Reported{});
    held.report_loops(0);
    CHECK(held.reported_at(3s) == Reported{false});
    CHECK(held.reported_at(4s) == Reported{});
  }

  TEST_CASE("it no longer does when it has not said so for 5 s, and when another vehicle is there") {
    HeldSubmarine held;
    held.report_loops(imc::CLoopsMask::DEPTH);
    CHECK(held.reported_at(1s) == Reported{true});
    CHECK(held.reported_at(4999ms) == Reported{});
    CHECK(held.reported_at(5s) == Reported{false});
    held.report_loops(imc::CLoopsMask::DEPTH);
    CHECK(held.reported_at(6s) == Reported{true});
    held.vehicle->peer_changed();
    CHECK(held.reported_at(7s) == Reported{false});
  }

  TEST_CASE("what could not be reported is reported again") {
    HeldSubmarine held;
    held.holder.listens = false;
    held.report_loops(imc::CLoopsMask::DEPTH);
    CHECK(held.reported_at(1s) == Reported{true});
    CHECK(held.reported_at(2s) == Reported{true});
    held.holder.listens = true;
    CHECK(held.reported_at(3s) == Reported{true});
    CHECK(held.reported_at(4s) == Reported{});
  }
}

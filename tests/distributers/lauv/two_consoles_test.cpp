// Two consoles at once at a submarine's link, each at an address and with an id of its own.
#include <doctest/doctest.h>
#include <sys/socket.h>

#include <chrono>
#include <memory>
#include <vector>

#include "distributers/interfaces/typed.h"
#include "distributers/lauv/operator.h"
#include "distributers/links/linked.h"
#include "distributers/links/udp.h"
#include "distributers/messages/imc.h"
#include "distributers/messages/packet.h"
#include "tests/distributers/links/open_link.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
using namespace std::chrono_literals;
namespace imc = messages::imc;
using tests::any, tests::wait_for;

constexpr std::uint16_t vehicle = 0x00D1;

// A vehicle with places for two.
struct Vehicle {
  Vehicle() {
    auto transport = std::make_unique<UdpTransport>(any, Address{}, std::vector<Address>{}, 1h, 2);
    const UdpTransport& at = *transport;
    LinkOptions options;
    options.header = {{"src", vehicle}};
    system = std::make_unique<LinkedSystem>(std::make_unique<Link>(std::move(transport), imc::message_set(), options),
                                            std::make_unique<Typed<LauvOperator>>(LauvOperatorParameters{}));
    system->begin();
    address = any.with_port(at.port());
  }
  ~Vehicle() { system->finish(); }
  std::uint64_t count(const std::string& name) const { return tests::count_of(system->link(), name); }
  void step() { system->reach(now += 50ms); }
  tasks::Setpoint setpoint() {
    system->take(0, &last_setpoint);
    return last_setpoint;
  }
  double silence() {
    tasks::Contact contact;
    REQUIRE(system->take(3, &contact));
    return contact.silence;
  }

  std::unique_ptr<LinkedSystem> system;
  Address address;
  Duration now{};
  tasks::Setpoint last_setpoint;
};

class NetConsole {
 public:
  NetConsole(Vehicle& to, std::uint16_t id) : vehicle_(to), speaker_(to.address, SOCK_DGRAM), id_(id) {}
  // It is there before the next instant.
  template <class M>
  void say(const M& message) {
    imc::Header header;
    header.src = id_;
    header.dst = vehicle;
    header.timestamp = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
    std::vector<std::byte> bytes;
    REQUIRE(write_packet(messages::refer_to(header), messages::refer_to(message), imc::message_set().order, bytes));
    const std::uint64_t before = vehicle_.count("packets in");
    speaker_.say(bytes);
    REQUIRE(wait_for([&] { return vehicle_.count("packets in") == before + 1; }));
  }
  // Of all that came so far, to how many each message of that form was addressed to.
  template <class M>
  std::vector<std::uint16_t> addressees_of() {
    messages::PacketReader reader(imc::message_set());
    for (auto bytes = speaker_.heard(); !bytes.empty(); bytes = speaker_.heard()) got_.push_back(bytes);
    std::vector<std::uint16_t> to;
    for (const auto& bytes : got_)
      if (reader.read(bytes) == messages::PacketError::none && reader.message().template as<M>() != nullptr)
        to.push_back(static_cast<const imc::Header*>(reader.header().value)->dst);
    return to;
  }

 private:
  Vehicle& vehicle_;
  tests::Speaker speaker_;
  std::uint16_t id_;
  std::vector<std::vector<std::byte>> got_;
};

const imc::DesiredZ& depth_of(float depth) {
  static imc::DesiredZ z;
  return z = {depth, imc::ZUnits::DEPTH};
}
}  // namespace

TEST_SUITE("distributers/lauv/two_consoles") {
  TEST_CASE("each of two consoles hears all, and what it asked is answered to its id") {
    Vehicle dune;
    NetConsole one(dune, 0x4001), other(dune, 0x4002);
    one.say(imc::Heartbeat{});
    other.say(imc::Heartbeat{});
    REQUIRE(wait_for([&] { return dune.count("peers") == 2; }));
    one.say(imc::EntityList{imc::EntityList::Op::QUERY, ""});
    other.say(imc::EntityList{imc::EntityList::Op::QUERY, ""});
    other.say(imc::PlanDB{.type = imc::PlanDB::Type::REQUEST, .op = imc::PlanDB::Op::GET_STATE});
    for (int i = 0; i < 60; ++i) dune.step();
    const std::uint16_t all = imc::Header{}.dst;
    for (NetConsole* console : {&one, &other}) {
      REQUIRE(wait_for([&] { return console->addressees_of<imc::VehicleState>().size() == 4; }));
      CHECK(console->addressees_of<imc::VehicleState>() == std::vector<std::uint16_t>(4, all));
      CHECK(console->addressees_of<imc::EntityList>() == std::vector<std::uint16_t>{0x4001, 0x4002});
      CHECK(console->addressees_of<imc::PlanDB>() == std::vector<std::uint16_t>{0x4002});
    }
  }

  TEST_CASE("what either commands is obeyed, and the silence of who commanded last counts, whatever the other says") {
    Vehicle dune;
    NetConsole one(dune, 0x4001), other(dune, 0x4002);
    one.say(depth_of(2));
    other.say(imc::Heartbeat{});
    dune.step();
    CHECK(dune.setpoint().depth == doctest::Approx(2));
    for (int i = 0; i < 40; ++i) {
      other.say(imc::Heartbeat{});
      one.say(imc::Heartbeat{});
      dune.step();
      CHECK(dune.silence() == doctest::Approx(0.05));  // both are heard by turns, and nobody has taken over
    }
    for (int i = 0; i < 40; ++i) {
      other.say(imc::Heartbeat{});
      dune.step();
    }
    CHECK(dune.silence() == doctest::Approx(2.05));
    other.say(depth_of(1));
    dune.step();
    CHECK(dune.setpoint().depth == doctest::Approx(1));
    CHECK(dune.silence() == doctest::Approx(0.05));
  }

  TEST_CASE("a commander that comes again from another port, while the other stayed, is in contact again") {
    Vehicle dune;
    NetConsole other(dune, 0x4002);
    other.say(imc::Heartbeat{});
    {
      NetConsole one(dune, 0x4001);
      one.say(depth_of(2));
      dune.step();
    }
    REQUIRE(wait_for([&] { return dune.step(), dune.count("closed ports") == 1; }));
    NetConsole again(dune, 0x4001);
    again.say(imc::Heartbeat{});
    dune.step();
    CHECK(dune.setpoint().depth == doctest::Approx(2));
    CHECK(dune.silence() == doctest::Approx(0.05));
  }

  TEST_CASE("when both have gone, who comes then is the operator from its first command on") {
    Vehicle dune;
    {
      NetConsole one(dune, 0x4001), other(dune, 0x4002);
      one.say(depth_of(2));
      other.say(imc::Heartbeat{});
      dune.step();
    }
    REQUIRE(wait_for([&] { return dune.step(), dune.count("closed ports") == 2; }));
    NetConsole next(dune, 0x4001);
    next.say(imc::Heartbeat{});
    const double before = dune.silence();
    dune.step();
    CHECK(dune.silence() == doctest::Approx(before + 0.05));
    next.say(depth_of(1));
    dune.step();
    CHECK(dune.setpoint().depth == doctest::Approx(1));
    CHECK(dune.silence() == doctest::Approx(0.05));
  }
}

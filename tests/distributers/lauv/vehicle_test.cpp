#include "distributers/lauv/vehicle.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "distributers/interfaces/typed.h"
#include "distributers/messages/imc.h"
#include "distributers/messages/payload.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
using In = LauvVehicle::In;
namespace imc = messages::imc;

struct SentToSubmarine : messages::Receiver {
  void receive(messages::MessageRef message) override {
    if (const auto* t = message.as<imc::SetThrusterActuation>()) {
      thruster.push_back(*t);
      order += "t";
    }
    if (const auto* s = message.as<imc::SetServoPosition>()) {
      servos.push_back(*s);
      order += std::to_string(s->id);
    }
  }
  std::string order;
  std::vector<imc::SetThrusterActuation> thruster;
  std::vector<imc::SetServoPosition> servos;
};
}  // namespace

TEST_SUITE("distributers/lauv_vehicle") {
  TEST_CASE("a simulated state becomes motion, taken once") {
    Typed<LauvVehicle> adapter;
    tasks::Motion motion;
    CHECK_FALSE(adapter.take<&In::motion>(motion));
    imc::SimulatedState state;
    state.z = 2.5F;
    state.psi = 0.1F;
    state.u = 1.2F;
    state.r = -0.3F;
    adapter.receive(messages::refer_to(state));
    CHECK(adapter.take<&In::motion>(motion));
    CHECK(motion.z == 2.5);
    CHECK(motion.psi == static_cast<double>(0.1F));  // the wire's 32 bits, in process too
    CHECK(motion.u == static_cast<double>(1.2F));
    CHECK(motion.r == static_cast<double>(-0.3F));
    CHECK_FALSE(adapter.take<&In::motion>(motion));
  }

  TEST_CASE("an estimated state becomes motion as well, whichever came last; its depth counts") {
    Typed<LauvVehicle> adapter;
    tasks::Motion motion;
    imc::SimulatedState truth;
    truth.z = 2.5F;
    imc::EstimatedState estimate;
    estimate.x = 1;
    estimate.z = 7;
    estimate.depth = 3;
    estimate.u = 1.5F;
    estimate.vx = 9;
    estimate.q = 0.25F;
    adapter.receive(messages::refer_to(truth));
    adapter.receive(messages::refer_to(estimate));
    CHECK(adapter.take<&In::motion>(motion));
    CHECK(motion.x == 1);
    CHECK(motion.z == 3);
    CHECK(motion.u == 1.5);
    CHECK(motion.q == 0.25);
    adapter.receive(messages::refer_to(truth));
    CHECK(adapter.take<&In::motion>(motion));
    CHECK(motion.z == 2.5);
  }

  TEST_CASE("it announces itself as a control unit, for DUNE listens to nobody else") {
    struct Heard : messages::Receiver {
      void receive(messages::MessageRef message) override {
        if (const auto* a = message.as<imc::Announce>()) announces.push_back(*a);
      }
      std::vector<imc::Announce> announces;
    } heard;
    Typed<LauvVehicle> adapter;
    adapter.listen_at("udp://127.0.0.1:7002");
    for (Duration now{}; now < std::chrono::seconds(11); now += std::chrono::seconds(1)) adapter.announce(now, heard);
    REQUIRE(heard.announces.size() == 2);
    CHECK(heard.announces[0].sys_name == "jarol");
    CHECK(heard.announces[0].sys_type == imc::SystemType::CCU);
    CHECK(heard.announces[0].services == "imc+info://0.0.0.0/version/5.4.31;imc+udp://127.0.0.1:7002/");
  }

  TEST_CASE("an actuation becomes one thruster and four servo messages, in that order") {
    Typed<LauvVehicle> adapter;
    SentToSubmarine sent;
    const tasks::Actuation actuation{0.5, {0.1, 0.2, 0.3, 0.4}};
    adapter.hand_over<&LauvVehicle::Out::actuation>(actuation, sent);
    CHECK(sent.order == "t0123");
    REQUIRE(sent.thruster.size() == 1);
    CHECK(sent.thruster[0].value == 0.5F);
    REQUIRE(sent.servos.size() == 4);
    CHECK(sent.servos[2].id == 2);
    CHECK(sent.servos[2].value == 0.3F);
  }

  TEST_CASE("readings become instruments, counted; what is no number is none") {
    Typed<LauvVehicle> adapter;
    tasks::Instruments i;
    CHECK_FALSE(adapter.take<&In::instruments>(i));
    imc::Depth depth;
    depth.value = 2.5F;
    adapter.receive(messages::refer_to(depth));
    adapter.receive(messages::refer_to(depth));
    imc::EulerAngles angles;
    angles.phi = angles.theta = angles.psi = std::numeric_limits<double>::quiet_NaN();
    angles.psi_magnetic = 1.5;
    adapter.receive(messages::refer_to(angles));
    imc::EntityState entity;
    entity.state = imc::EntityState::State::FAILURE;
    adapter.receive(messages::refer_to(entity));
    imc::Distance range;
    range.value = 30;
    adapter.receive(messages::refer_to(range));  // not valid
    CHECK(adapter.take<&In::instruments>(i));
    CHECK(i.depth.value == 2.5);
    CHECK(i.depth.count == 2);
    CHECK(i.heading.value == 1.5);
    CHECK(i.attitude.count == 0);
    CHECK(i.leak.value == 1);
    CHECK(i.altitude.count == 0);
    CHECK_FALSE(adapter.take<&In::instruments>(i));
    tasks::Motion motion;
    CHECK_FALSE(adapter.take<&In::motion>(motion));
  }

  TEST_CASE("a reading that is not finite is counted and left out, unless others stand beside it") {
    constexpr double none = std::numeric_limits<double>::quiet_NaN(), beyond = std::numeric_limits<double>::infinity();
    Typed<LauvVehicle> adapter;
    tasks::Instruments i;
    imc::EulerAngles angles;
    angles.phi = angles.theta = angles.psi = none;
    angles.psi_magnetic = 1.5;
    adapter.receive(messages::refer_to(angles));  // a compass
    angles.phi = angles.theta = angles.psi = 0.1;
    angles.psi_magnetic = none;
    adapter.receive(messages::refer_to(angles));  // an IMU
    CHECK(adapter.non_finite_inputs() == 0);
    CHECK(adapter.take<&In::instruments>(i));
    CHECK(i.heading.count == 1);
    CHECK(i.attitude.count == 1);

    angles.theta = none;  // its roll and heading alone are no attitude
    adapter.receive(messages::refer_to(angles));
    angles.theta = beyond;
    adapter.receive(messages::refer_to(angles));
    CHECK(adapter.non_finite_inputs() == 2);
    angles.phi = angles.theta = angles.psi = none;  // nothing at all
    adapter.receive(messages::refer_to(angles));
    CHECK(adapter.non_finite_inputs() == 4);
    imc::Depth depth;
    depth.value = static_cast<float>(beyond);
    adapter.receive(messages::refer_to(depth));
    imc::AngularVelocity rates;
    rates.y = none;
    adapter.receive(messages::refer_to(rates));
    imc::GpsFix fix;
    fix.validity = imc::GpsFix::Validity::VALID_POS;
    fix.lat = none;
    adapter.receive(messages::refer_to(fix));
    CHECK(adapter.non_finite_inputs() == 7);
    CHECK_FALSE(adapter.take<&In::instruments>(i));
  }

  TEST_CASE("a fix that is not valid, a range that is not, and a dry hull are none of what they might be") {
    Typed<LauvVehicle> adapter;
    tasks::Instruments i;
    imc::GpsFix fix;
    fix.lat = 0.7;
    adapter.receive(messages::refer_to(fix));
    imc::Distance range;
    range.value = 30;
    adapter.receive(messages::refer_to(range));
    CHECK_FALSE(adapter.take<&In::instruments>(i));
    range.validity = imc::Distance::Validity::VALID;
    adapter.receive(messages::refer_to(range));
    imc::EntityState entity;
    entity.state = imc::EntityState::State::NORMAL;
    adapter.receive(messages::refer_to(entity));
    CHECK(adapter.take<&In::instruments>(i));
    CHECK(i.place.count == 0);
    CHECK(i.altitude.value == 30);
    CHECK(i.leak.count == 1);
    CHECK(i.leak.value == 0);
  }

  TEST_CASE("a fix becomes metres along meridian and parallel, which come together to the north") {
    Typed<LauvVehicle> adapter;
    tasks::Instruments i;
    imc::GpsFix fix;
    fix.validity = imc::GpsFix::Validity::VALID_POS;
    fix.lat = 1;  // rad
    fix.lon = 0.5;
    adapter.receive(messages::refer_to(fix));
    fix.lat += 1e-5;
    fix.lon += 1e-5;
    adapter.receive(messages::refer_to(fix));
    CHECK(adapter.take<&In::instruments>(i));
    // through the centre of the earth: WGS-84 as an ellipsoid of 6378137 and 6356752.314245 m, chords of the two points
    const auto point = [](double latitude, double longitude) {
      const double a = 6378137.0, b = 6356752.314245;
      const double n = a * a / std::hypot(a * std::cos(latitude), b * std::sin(latitude));
      return std::array{n * std::cos(latitude) * std::cos(longitude), n * std::cos(latitude) * std::sin(longitude),
                        b * b / (a * a) * n * std::sin(latitude)};
    };
    const auto apart = [](const auto& p, const auto& q) { return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]); };
    CHECK(i.place.x == doctest::Approx(apart(point(1, 0.5), point(1 + 1e-5, 0.5))).scale(0).epsilon(1e-5));
    CHECK(i.place.y == doctest::Approx(apart(point(1, 0.5), point(1, 0.5 + 1e-5))).scale(0).epsilon(1e-5));
  }

  TEST_CASE("places are measured from the origin of plans, wherever the first fix is") {
    Typed<LauvVehicle> adapter;
    imc::GpsFix fix;
    fix.validity = imc::GpsFix::Validity::VALID_POS;
    fix.lat = 41.1850 * degree + 1e-5;
    fix.lon = -8.7062 * degree - 1e-5;
    adapter.receive(messages::refer_to(fix));
    tasks::Instruments i;
    CHECK(adapter.take<&In::instruments>(i));
    CHECK(i.place.x == doctest::Approx(63.63).scale(0).epsilon(1e-3));
    CHECK(i.place.y == doctest::Approx(-48.07).scale(0).epsilon(1e-3));
  }

  TEST_CASE("a range counts once it is known where its transponder lies, from the same origin") {
    Typed<LauvVehicle> adapter;
    tasks::Instruments i;
    adapter.receive(messages::refer_to(imc::LblRange{0, 70}));
    CHECK_FALSE(adapter.take<&In::instruments>(i));
    const imc::LblBeacon beacon{.lat = 41.1850 * degree + 1e-5, .lon = -8.7062 * degree, .depth = 12};
    imc::LblConfig config;
    config.op = imc::LblConfig::Op::CUR_CFG;
    messages::InlineMessage packed;
    REQUIRE(messages::put_inline(messages::refer_to(beacon), packed));
    config.beacons.push_back(packed);
    adapter.receive(messages::refer_to(config));
    adapter.receive(messages::refer_to(imc::LblRange{0, 70}));
    adapter.receive(messages::refer_to(imc::LblRange{1, 80}));  // there is none
    adapter.receive(messages::refer_to(imc::LblRange{200, 80}));
    CHECK(adapter.take<&In::instruments>(i));
    CHECK(i.beacons[0].range == 70);
    CHECK(i.beacons[0].count == 1);
    CHECK(i.beacons[0].north == doctest::Approx(63.63).scale(0).epsilon(1e-3));
    CHECK(i.beacons[0].east == 0);
    CHECK(i.beacons[0].depth == 12);
    CHECK(i.beacons[1].count == 0);
    adapter.receive(messages::refer_to(imc::LblRange{0, std::numeric_limits<float>::quiet_NaN()}));
    CHECK(adapter.non_finite_inputs() == 1);
    config.op = imc::LblConfig::Op::GET_CFG;  // a question
    config.beacons.clear();
    adapter.receive(messages::refer_to(config));
    adapter.receive(messages::refer_to(imc::LblRange{0, 71}));
    CHECK(adapter.take<&In::instruments>(i));
    CHECK(i.beacons[0].range == 71);
    config.op = imc::LblConfig::Op::SET_CFG;  // there are none any more
    adapter.receive(messages::refer_to(config));
    adapter.receive(messages::refer_to(imc::LblRange{0, 72}));
    CHECK_FALSE(adapter.take<&In::instruments>(i));
  }

  TEST_CASE("the first fix is the origin where it is more than 100 km from that of plans") {
    Typed<LauvVehicle> adapter;
    imc::GpsFix fix;
    fix.validity = imc::GpsFix::Validity::VALID_POS;
    fix.lat = 0.7;
    fix.lon = -0.15;
    adapter.receive(messages::refer_to(fix));
    fix.lat += 1e-5;
    fix.lon -= 1e-5;
    adapter.receive(messages::refer_to(fix));
    fix.validity = 0;
    fix.lat = 0;
    adapter.receive(messages::refer_to(fix));
    tasks::Instruments i;
    CHECK(adapter.take<&In::instruments>(i));
    CHECK(i.place.count == 2);
    // radii of the ellipsoid at 0.7 rad: 6362 km along the meridian, 4889 km of the parallel
    CHECK(i.place.x == doctest::Approx(63.62).scale(0).epsilon(1e-3));
    CHECK(i.place.y == doctest::Approx(-48.85).scale(0).epsilon(2e-3));
  }

  TEST_CASE("other messages change nothing") {
    Typed<LauvVehicle> adapter;
    adapter.receive(messages::refer_to(imc::SetServoPosition{}));
    tasks::Motion motion;
    CHECK_FALSE(adapter.take<&In::motion>(motion));
  }
}

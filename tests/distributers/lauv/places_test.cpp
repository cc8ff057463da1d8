// Places of the submarine and its transponders, as they come, in metres from the origin.
#include <doctest/doctest.h>

#include <tuple>

#include "distributers/interfaces/typed.h"
#include "distributers/lauv/vehicle.h"
#include "distributers/messages/imc.h"
#include "distributers/messages/payload.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
using In = LauvVehicle::In;
namespace imc = messages::imc;

constexpr double step = 1e-5;  // rad, to either side of the date line

void send_fix(Typed<LauvVehicle>& adapter, double latitude, double longitude) {
  imc::GpsFix fix;
  fix.validity = imc::GpsFix::Validity::VALID_POS;
  fix.lat = latitude;
  fix.lon = longitude;
  adapter.receive(messages::refer_to(fix));
}
}  // namespace

TEST_SUITE("distributers/lauv/places") {
  TEST_CASE("across the date line it is as far as anywhere else, eastwards and westwards") {
    const double far_east = pi - step, far_west = step - pi;
    for (const auto& [origin, place, side] : {std::tuple{far_east, far_west, 1}, {far_west, far_east, -1}}) {
      Typed<LauvVehicle> adapter;
      send_fix(adapter, -0.3, origin);  // so far from the usual origin that it is one itself
      send_fix(adapter, -0.3, place);
      tasks::Instruments i;
      CHECK(adapter.take<&In::instruments>(i));
      CHECK(i.place.x == 0);
      CHECK(i.place.y == doctest::Approx(side * 2 * step * earth_radii(-0.3).east));

      imc::LblConfig config;
      config.op = imc::LblConfig::Op::CUR_CFG;
      messages::InlineMessage packed;
      REQUIRE(messages::put_inline(messages::refer_to(imc::LblBeacon{.lat = -0.3, .lon = place}), packed));
      config.beacons.push_back(packed);
      adapter.receive(messages::refer_to(config));
      adapter.receive(messages::refer_to(imc::LblRange{0, 70}));
      CHECK(adapter.take<&In::instruments>(i));
      CHECK(i.beacons[0].east == doctest::Approx(side * 2 * step * earth_radii(-0.3).east));
    }
  }

  TEST_CASE("the origin that is stated stays where the first fix is across the date line from it") {
    Typed<LauvVehicle> adapter({.latitude = 0.9, .longitude = pi - step});
    send_fix(adapter, 0.9, step - pi);
    tasks::Instruments i;
    CHECK(adapter.take<&In::instruments>(i));
    CHECK(i.place.y == doctest::Approx(2 * step * earth_radii(0.9).east));
  }
}

// References as legs: places, speeds, circles.
#include "distributers/lauv/reference_follower.h"

#include <doctest/doctest.h>

#include <limits>
#include <stdexcept>

#include "graph/math/geometry.h"
#include "graph/text/errors.h"
#include "tests/distributers/lauv/inline_messages.h"
#include "tests/distributers/lauv/origin.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
namespace imc = messages::imc;
using jarol::tests::packed;
using Flags = imc::Reference::Flags;
using tasks::Course;

using tests::origin;
const tasks::Motion motion = [] {
  tasks::Motion m;
  m.x = 12;
  m.y = -7;
  return m;
}();

struct Follows {
  ReferenceFollower follower{{.control_source = 0xffff, .control_entity = 0xff}, Duration{}};

  void take(const imc::Reference& reference) { REQUIRE_NOTHROW(follower.take(reference, 1, 1, {}, origin, motion)); }
  void refuse(const imc::Reference& reference, const char* why) {
    CHECK_THROWS_WITH_AS(follower.take(reference, 1, 1, {}, origin, motion), why, InputError);
  }
  // The vehicle is at the end of its line.
  void arrive() {
    tasks::Progress progress;
    progress.done = true;
    CHECK(follower.note(progress));
  }
};

imc::Reference reference_to(double depth) {
  imc::Reference reference;
  reference.flags = Flags::Z;
  reference.z = packed(imc::DesiredZ{static_cast<float>(depth), imc::ZUnits::DEPTH});
  return reference;
}

imc::Reference reference_at_speed(double speed) {
  imc::Reference reference;
  reference.flags = Flags::SPEED;
  reference.speed = packed(imc::DesiredSpeed{speed, imc::SpeedUnits::METERS_PS});
  return reference;
}
}  // namespace

TEST_SUITE("distributers/lauv_reference_follower") {
  TEST_CASE("a first reference without a place is for where the vehicle is") {
    Follows f;
    CHECK(f.follower.leg().course == Course::rest);
    f.take(reference_to(4));
    CHECK(f.follower.leg().course == Course::line);
    CHECK(f.follower.leg().north == 12);
    CHECK(f.follower.leg().east == -7);
    CHECK(f.follower.leg().level == 4);
    f.arrive();
    CHECK(f.follower.leg().course == Course::circle);
    f.take(reference_to(6));
    CHECK(f.follower.leg().course == Course::circle);
    CHECK(f.follower.leg().north == 12);
    CHECK(f.follower.leg().level == 6);
  }

  TEST_CASE(
      "where it ends at the surface it keeps its station, else it circles, counterclockwise for a negative radius") {
    Follows f;
    imc::Reference reference = reference_to(3);
    reference.flags |= Flags::RADIUS;
    reference.radius = -14;
    f.take(reference);
    f.arrive();
    CHECK(f.follower.leg().course == Course::circle);
    CHECK(f.follower.leg().radius == -14);
    reference.radius = -3;  // too small for the vehicle
    f.take(reference);
    CHECK(f.follower.leg().radius == -10);
    reference.radius = 30;
    f.take(reference);
    CHECK(f.follower.leg().radius == 30);
    reference.radius = std::numeric_limits<float>::infinity();
    f.refuse(reference, "the reference's radius is no number");
    CHECK(f.follower.leg().radius == 30);

    Follows at_surface;
    reference = reference_to(0);
    reference.flags |= Flags::RADIUS;
    reference.radius = -14;
    at_surface.take(reference);
    at_surface.arrive();
    CHECK(at_surface.follower.leg().course == Course::station);
    CHECK(at_surface.follower.leg().radius == 14);
  }

  TEST_CASE("at speed 0 the propeller is off, until another speed comes") {
    Follows f;
    f.take(reference_at_speed(1.4));
    CHECK(f.follower.leg().drive == tasks::Drive::speed);
    CHECK(f.follower.leg().surge == doctest::Approx(1.4));
    f.take(reference_at_speed(0));
    CHECK(f.follower.leg().drive == tasks::Drive::thrust);
    CHECK(f.follower.leg().thrust == 0);
    f.take(reference_to(2));
    CHECK(f.follower.leg().thrust == 0);
    CHECK(f.follower.leg().drive == tasks::Drive::thrust);
    f.take(reference_at_speed(1));
    CHECK(f.follower.leg().drive == tasks::Drive::speed);
    f.refuse(reference_at_speed(-1), "speed is -1 m/s; speeds are 0.2 to 2 m/s");
    CHECK(f.follower.leg().surge == 1);
  }
}

#include "vehicles/helicopter/coefficients.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "graph/text/errors.h"

namespace jarol::vehicles {
namespace {

void need(bool good, const std::string& what) {
  if (!good) throw InputError(what);
}

// what is dropped by chance is carried at first, even if it may be dropped from the start
double payload_at_start(const PayloadParameters& payload) {
  return payload.at > 0.0 || payload.chance > 0.0 ? payload.mass : 0.0;
}

}  // namespace

HelicopterBody make_body(const HelicopterParameters& parameters) {
  const FrameParameters& frame = parameters.frame;
  const RotorParameters& rotors = parameters.rotors;
  const FeetParameters& feet = parameters.feet;
  need(frame.mass > 0.0, "its mass has to be above zero");
  need(frame.I_x > 0.0 && frame.I_y > 0.0 && frame.I_z > 0.0, "its moments of inertia have to be above zero");
  need(frame.I_x + frame.I_y >= frame.I_z && frame.I_y + frame.I_z >= frame.I_x && frame.I_z + frame.I_x >= frame.I_y,
       "none of its moments of inertia can exceed the sum of the other two");
  need(rotors.radius > 0.0 && rotors.full_thrust > 0.0 && rotors.thrust_exponent > 0.0 && rotors.lag > 0.0 &&
           rotors.reference_voltage > 0.0,
       "its rotors' radius, full thrust, exponent, lag and reference voltage have to be above zero");
  need(rotors.inertia >= 0.0 && rotors.full_speed >= 0.0 && rotors.drag >= 0.0 && rotors.inflow >= 0.0,
       "its rotors' inertia, full speed, drag and inflow can't be below zero");
  need(rotors.ground_effect >= 0.0, "its ground effect can't be below zero");
  need(feet.height > 0.0 && feet.stiffness > 0.0 && feet.dissipation >= 0.0 && feet.friction >= 0.0,
       "its feet need height and stiffness above zero, dissipation and friction not below zero");

  need(parameters.sensors.sonars == 1 || parameters.sensors.sonars == 4, "it has one sonar or four");
  need(parameters.payload.mass >= 0.0, "its payload can't be below zero");
  need(parameters.air.roughness >= 0.0 && parameters.air.wind_height > parameters.air.roughness &&
           parameters.air.gust.time > 0.0,
       "its ground's roughness has to lie between zero and the height of the wind, and a gust takes time");
  need(parameters.battery.capacity > 0.0 && parameters.air.gust_time > 0.0,
       "its battery's capacity and the time of gusts have to be above zero");

  const BatteryParameters& battery = parameters.battery;
  need(battery.resistance >= 0.0, "its battery's resistance can't be below zero");
  need(battery.empty <= battery.full,
       fmt::format("battery.empty must not be above battery.full, and is {} V where that is {} V", battery.empty,
                   battery.full));
  const SensorParameters& room = parameters.sensors;
  need(
      room.wall_north > -room.wall_south && room.wall_east > -room.wall_west,
      fmt::format("the wall in the north must lie north of that in the south, and that in the east east of that in the "
                  "west; they are {} m north, {} m south, {} m east and {} m west of the origin",
                  room.wall_north, room.wall_south, room.wall_east, room.wall_west));

  HelicopterBody body;
  body.mass = frame.mass;
  body.payload = payload_at_start(parameters.payload);
  body.gravity = parameters.air.gravity;
  body.inertia = {frame.I_x, frame.I_y, frame.I_z};
  const double a = rotors.arm, h = -rotors.height;
  body.rotors = {{{{a, 0.0, h}, 1.0}, {{0.0, a, h}, -1.0}, {{-a, 0.0, h}, 1.0}, {{0.0, -a, h}, -1.0}}};
  body.full_thrust = rotors.full_thrust;
  body.thrust_law = ThrustLaw(rotors.thrust_exponent);
  body.lag = rotors.lag;
  body.torque_per_thrust = rotors.torque_per_thrust;
  body.rotor_inertia = rotors.inertia;
  body.full_speed = rotors.full_speed;
  body.rotor_drag = rotors.drag;
  body.rotor_inflow = rotors.inflow;
  body.rotor_radius = rotors.radius;
  body.ground_effect = rotors.ground_effect;
  body.drag = 0.5 * parameters.air.density * frame.drag_area;

  const auto around = [&](std::size_t first, double r, double down) {
    const std::array<fossen::Vector3, 4> points{{{r, 0.0, down}, {0.0, r, down}, {-r, 0.0, down}, {0.0, -r, down}}};
    std::copy(points.begin(), points.end(), body.feet.r_b.begin() + static_cast<std::ptrdiff_t>(first));
  };
  around(0, feet.radius, feet.height);
  around(4, a, h);
  around(8, a + rotors.radius, h);
  body.feet.r_b[12] = {0.0, 0.0, -frame.top};
  body.feet.reach = 0.0;
  for (const fossen::Vector3& r_b : body.feet.r_b)
    body.feet.reach = std::max(body.feet.reach, std::sqrt(fossen::dot(r_b, r_b)));
  body.feet.stiffness = feet.stiffness;
  body.feet.dissipation = feet.dissipation;
  body.feet.friction = feet.friction;
  body.feet.grip_stiffness = feet.stiffness;
  // half of what is critical for the whole mass on four feet
  body.feet.grip_damping = 0.5 * std::sqrt(feet.stiffness * frame.mass);
  return body;
}

HelicopterMotion make_start(const HelicopterParameters& parameters) {
  const LiftOffParameters& start = parameters.start;
  need(start.altitude >= 0.0, "its start can't be below the ground");
  need(start.signal >= 0.0 && start.signal <= 16000.0, "its motor signal at the start has to be from 0 to 16000");
  const double mass = parameters.frame.mass + payload_at_start(parameters.payload);
  const double sunk = mass * parameters.air.gravity / (4.0 * parameters.feet.stiffness);
  HelicopterMotion motion;
  motion.p_n = {start.north, start.east, sunk - parameters.feet.height - start.altitude};
  const double c = std::cos(start.heading), s = std::sin(start.heading);
  motion.R_nb = {{{c, -s, 0.0}, {s, c, 0.0}, {0.0, 0.0, 1.0}}};
  return motion;
}

}  // namespace jarol::vehicles

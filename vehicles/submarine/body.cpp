#include "vehicles/submarine/body.h"

#include <cmath>
#include <cstddef>

#include "graph/math/geometry.h"

namespace jarol::vehicles {
namespace {

using fossen::Matrix6;
using fossen::Vector3;
using fossen::Vector6;

void add(Vector6& sum, const Vector6& term, double factor) {
  for (std::size_t i = 0; i < 6; ++i) sum[i] += factor * term[i];
}

// part of a fin or of the propeller's disc that is under water, smooth like the hull's own
double wetted(const Immersion& at, const Vector3& r_b, double reach) {
  return immersed_part((at.z + fossen::dot(at.down_b, r_b)) / reach);
}

// thin plate: lift and drag from the flow along the hull; sideward flow is in the lift of the hull with fins
Vector6 fin_force(const SubmarineBody& body, const SubmarineBody::Fin& fin, double angle, double u) {
  const double alpha = limited(angle, body.fin_stall);
  const double lift = body.fin_lift * alpha * u * std::abs(u);
  const double drag = body.fin_drag * alpha * alpha * u * std::abs(u);
  const Vector3 force = {lift * fin.lift_b[0] - drag, lift * fin.lift_b[1], lift * fin.lift_b[2]};
  const Vector3 moment = fossen::cross(fin.r_b, force);
  return {force[0], force[1], force[2], moment[0], moment[1], moment[2]};
}

// what moving water does beside the flow past the hull: the water that the hull takes along needs to be moved less, and
// the pressure that moves the water about is there on the hull too
Vector6 moving_water_force(const SubmarineBody& body, const Surroundings& around, const Vector3& omega) {
  const Vector3 turning = fossen::cross(omega, around.velocity_b);
  const Vector3& a = around.acceleration_b;
  Vector6 force = fossen::multiply(body.M_a, {a[0] - turning[0], a[1] - turning[1], a[2] - turning[2], 0.0, 0.0, 0.0});
  for (std::size_t i = 0; i < 3; ++i) force[i] += body.displaced * a[i];
  return force;
}

}  // namespace

double calc_thrust(const SubmarineBody::Propeller& propeller, double n, double speed) {
  const double thrust = (propeller.thrust * n - propeller.advance * speed) * std::abs(n);
  return limited(thrust, propeller.limit);
}

Vector6 calc_nu_dot(const SubmarineBody& body, const Surroundings& around, const Vector6& nu,
                    const SubmarineInput& input) {
  const Immersion& at = around.at;
  const Immersed immersed = calc_immersed(body.hull, at);
  const Vector3& v_c = around.velocity_b;
  const Vector6 nu_r = {nu[0] - v_c[0], nu[1] - v_c[1], nu[2] - v_c[2], nu[3], nu[4], nu[5]};

  // air neither damps nor lifts; the added mass stays as it is: the hull leaves the water only for moments
  Vector6 sum{};
  add(sum, damping_force(body.D, nu_r), immersed.part);
  add(sum, restoring_force(body.hull, immersed, at), 1.0);
  add(sum, fossen::coriolis(body.M_rb, nu), -1.0);
  add(sum, fossen::coriolis(body.M_a, nu_r), -1.0);
  add(sum, moving_water_force(body, around, {nu[3], nu[4], nu[5]}), immersed.part);
  add(sum, floor_force(body.floor, {around.z, at.down_b}, nu), 1.0);

  for (std::size_t i = 0; i < body.fins.size(); ++i) {
    const SubmarineBody::Fin& fin = body.fins[i];
    add(sum, fin_force(body, fin, input.fins[i], nu_r[0]), wetted(at, fin.r_b, body.fin_half_span));
  }
  const SubmarineBody::Propeller& propeller = body.propeller;
  sum[0] += calc_thrust(propeller, input.propeller, nu_r[0]) * wetted(at, {propeller.x, 0.0, 0.0}, propeller.radius);
  return fossen::multiply(body.M_inverse, sum);
}

}  // namespace jarol::vehicles

#include "vehicles/submarine_body.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

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
  const double alpha = std::clamp(angle, -body.fin_stall, body.fin_stall);
  const double lift = body.fin_lift * alpha * u * std::abs(u);
  const double drag = body.fin_drag * alpha * alpha * u * std::abs(u);
  const Vector3 force = {lift * fin.lift_b[0] - drag, lift * fin.lift_b[1], lift * fin.lift_b[2]};
  const Vector3 moment = fossen::cross(fin.r_b, force);
  return {force[0], force[1], force[2], moment[0], moment[1], moment[2]};
}

}  // namespace

Vector6 calc_nu_dot(const SubmarineBody& body, const Immersion& at, const Vector6& nu, const SubmarineInput& input) {
  const Immersed immersed = calc_immersed(body.hull, at);

  // air neither damps nor lifts; the added mass stays as it is: the hull leaves the water only for moments
  Vector6 sum{};
  add(sum, damping_force(body.D, nu), immersed.part);
  add(sum, restoring_force(body.hull, immersed, at), 1.0);
  add(sum, fossen::coriolis(body.M_rb, nu), -1.0);
  add(sum, fossen::coriolis(body.M_a, nu), -1.0);

  for (std::size_t i = 0; i < body.fins.size(); ++i) {
    const SubmarineBody::Fin& fin = body.fins[i];
    add(sum, fin_force(body, fin, input.fins[i], nu[0]), wetted(at, fin.r_b, body.fin_half_span));
  }
  sum[0] += input.thrust * wetted(at, {body.propeller_x, 0.0, 0.0}, body.propeller_radius);
  return fossen::multiply(body.M_inverse, sum);
}

}  // namespace jarol::vehicles

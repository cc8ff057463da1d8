#include "vehicles/submarine/coefficients.h"

#include <fmt/format.h>

#include <cstddef>
#include <string>

#include "graph/text/errors.h"

namespace jarol::vehicles {
namespace {

enum Axis : std::size_t { x, y, z, k, m, n };

void require_positive(double value, const char* what) {
  if (!(value > 0.0)) throw InputError(std::string("submarine: ") + what + " must be above zero");
}

fossen::Matrix6 make_added_mass(const AddedMassParameters& a) {
  fossen::Matrix6 M{};
  M[x][x] = -a.X_u_dot;
  M[y][y] = -a.Y_v_dot;
  M[z][z] = -a.Z_w_dot;
  M[k][k] = -a.K_p_dot;
  M[m][m] = -a.M_q_dot;
  M[n][n] = -a.N_r_dot;
  M[y][n] = M[n][y] = -a.Y_r_dot;
  M[z][m] = M[m][z] = -a.Z_q_dot;
  return M;
}

fossen::Damping make_damping(const SubmarineParameters& parameters) {
  fossen::Damping D;
  const LinearDampingParameters& l = parameters.linear_damping;
  const double linear_diagonal[] = {l.X_u, l.Y_v, l.Z_w, l.K_p, l.M_q, l.N_r};
  const QuadraticDampingParameters& q = parameters.quadratic_damping;
  const double quadratic_diagonal[] = {q.X_uu, q.Y_vv, q.Z_ww, q.K_pp, q.M_qq, q.N_rr};
  for (std::size_t i = 0; i < 6; ++i) {
    D.linear[i][i] = linear_diagonal[i];
    D.quadratic[i][i] = quadratic_diagonal[i];
  }
  D.linear[y][n] = l.Y_r;
  D.linear[z][m] = l.Z_q;
  D.linear[m][z] = l.M_w;
  D.linear[n][y] = l.N_v;
  D.quadratic[y][n] = q.Y_rr;
  D.quadratic[z][m] = q.Z_qq;
  D.quadratic[m][z] = q.M_ww;
  D.quadratic[n][y] = q.N_vv;

  const LiftParameters& a = parameters.lift;
  D.lift[y][y] = a.Y_uv;
  D.lift[y][n] = a.Y_ur;
  D.lift[z][z] = a.Z_uw;
  D.lift[z][m] = a.Z_uq;
  D.lift[m][z] = a.M_uw;
  D.lift[m][m] = a.M_uq;
  D.lift[n][y] = a.N_uv;
  D.lift[n][n] = a.N_ur;
  return D;
}

void scale(fossen::Matrix6& M, double factor) {
  for (fossen::Vector6& row : M)
    for (double& element : row) element *= factor;
}

}  // namespace

SubmarineBody make_body(const SubmarineParameters& parameters) {
  const HullParameters& hull = parameters.hull;
  const SeaParameters& sea = parameters.sea;
  require_positive(hull.mass, "hull.mass");
  require_positive(hull.length, "hull.length");
  require_positive(hull.diameter, "hull.diameter");
  if (hull.diameter > hull.length)
    throw InputError(
        fmt::format("submarine: hull.diameter must not be above hull.length, and is {} m where that is {} m",
                    hull.diameter, hull.length));
  require_positive(hull.I_x, "hull.I_x");
  require_positive(hull.I_y, "hull.I_y");
  require_positive(hull.I_z, "hull.I_z");
  require_positive(hull.water_density, "hull.water_density");
  require_positive(parameters.fins.half_span, "fins.half_span");
  require_positive(parameters.thruster.radius, "thruster.radius");
  require_positive(sea.density, "sea.density");
  require_positive(sea.gravity, "sea.gravity");
  require_positive(sea.floor, "sea.floor");

  // all that water does grows with its density
  const double density = sea.density / hull.water_density;
  SubmarineBody body;
  body.hull = {hull.mass * sea.gravity,
               density * hull.buoyancy,
               {0.0, 0.0, hull.z_g},
               {0.5 * hull.length, 0.5 * hull.diameter, 0.5 * hull.diameter}};
  body.displaced = body.hull.B / sea.gravity;
  body.floor = {sea.floor, 0.5 * hull.length, 0.5 * hull.diameter};
  body.M_rb = fossen::rigid_body_mass(hull.mass, body.hull.r_bg, {hull.I_x, hull.I_y, hull.I_z});
  body.M_a = make_added_mass(parameters.added_mass);
  scale(body.M_a, density);
  fossen::Matrix6 M = body.M_rb;
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) M[i][j] += body.M_a[i][j];
  }
  body.M_inverse = fossen::inverse(M);
  body.D = make_damping(parameters);
  scale(body.D.linear, density);
  scale(body.D.lift, density);
  scale(body.D.quadratic, density);

  // lift of the vertical fins to starboard, of the horizontal ones up: at the tail, that is to port and nose down
  const FinParameters& fins = parameters.fins;
  body.fins = {{{{fins.x, 0.0, fins.radius}, {0.0, 1.0, 0.0}},
                {{fins.x, -fins.radius, 0.0}, {0.0, 0.0, -1.0}},
                {{fins.x, fins.radius, 0.0}, {0.0, 0.0, -1.0}},
                {{fins.x, 0.0, -fins.radius}, {0.0, 1.0, 0.0}}}};
  body.fin_lift = density * fins.lift;
  body.fin_drag = density * fins.drag;
  body.fin_stall = fins.stall;
  body.fin_half_span = fins.half_span;
  const ThrusterParameters& thruster = parameters.thruster;
  body.propeller = {thruster.x, thruster.radius, density * thruster.thrust_coefficient,
                    density * thruster.advance_coefficient, thruster.max_thrust};
  return body;
}

}  // namespace jarol::vehicles

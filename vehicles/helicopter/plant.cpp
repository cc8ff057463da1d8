#include "vehicles/helicopter/plant.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "vehicles/mechanics/force_with_input.h"
#include "vehicles/mechanics/frames.h"
#include "vehicles/mechanics/integrator_archive.h"

namespace jarol::vehicles {
namespace {

using SimTK::State;
using SimTK::Vec3;

HelicopterMotion motion_of(const SimTK::MobilizedBody& body, const State& state) {
  const SimTK::Rotation& R_nb = body.getBodyRotation(state);
  const Vec3& p_n = body.getBodyOriginLocation(state);
  const fossen::Vector6 nu = to_body(R_nb, body.getBodyVelocity(state));
  HelicopterMotion motion;
  for (int i = 0; i < 3; ++i) {
    motion.p_n[i] = p_n[i];
    for (int j = 0; j < 3; ++j) motion.R_nb[i][j] = R_nb[i][j];
    motion.v_b[i] = nu[i];
    motion.omega_b[i] = nu[i + 3];
  }
  return motion;
}

class Loads : public ForceWithInput<HelicopterInput> {
 public:
  Loads(const SimTK::GeneralForceSubsystem& forces, const SimTK::MobilizedBody& mobilized, const HelicopterBody& body)
      : ForceWithInput(forces, mobilized), body_(body) {}

  void calcForce(const State& state, SimTK::Vector_<SimTK::SpatialVec>& body_forces, SimTK::Vector_<Vec3>&,
                 SimTK::Vector&) const override {
    const HelicopterMotion motion = motion_of(mobilized_, state);
    SimTK::SpatialVec load =
        to_ground(mobilized_.getBodyRotation(state), calc_loads(body_, motion, input(state), state.getTime()));
    load[1][2] += body_.mass * body_.gravity;
    mobilized_.applyBodyForce(state, load, body_forces);
  }

 private:
  const HelicopterBody& body_;
};

}  // namespace

struct HelicopterPlant::Simulation {
  Simulation(const HelicopterBody& properties, const HelicopterMotion& start)
      : helicopter(properties),
        matter(system),
        forces(system),
        body(matter.Ground(), SimTK::Transform(),
             SimTK::Body::Rigid(SimTK::MassProperties(
                 properties.mass, Vec3(0),
                 SimTK::Inertia(properties.inertia[0], properties.inertia[1], properties.inertia[2]))),
             SimTK::Transform()),
        loads(new Loads(forces, body, helicopter)),  // adopted by the force
        force(forces, loads),
        integrator(system),
        stepper(system, integrator) {
    State initial = system.realizeTopology();
    SimTK::Mat33 R;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) R[i][j] = start.R_nb[i][j];
    const SimTK::Rotation R_nb(R);
    body.setQToFitTransform(initial, {R_nb, Vec3(start.p_n[0], start.p_n[1], start.p_n[2])});
    body.setUToFitVelocity(initial, to_ground(R_nb, {start.v_b[0], start.v_b[1], start.v_b[2], start.omega_b[0],
                                                     start.omega_b[1], start.omega_b[2]}));
    // longer than any part of the grid: each part is one step, with no remainder of a rounding error
    integrator.setFixedStepSize(2e-9 * step_nanoseconds);
    stepper.initialize(initial);
    motion = motion_of(body, integrator.getAdvancedState());
    for (std::size_t i = 0; i < contact_count; ++i) {
      const FootMotion foot = foot_motion(motion, helicopter.feet.r_b[i]);
      input.anchors[i] = {foot.p_n[0], foot.p_n[1]};
    }
    input.payload = helicopter.payload;
  }

  // Simbody may notice a number that is not finite itself, or not at all; it must not be asked again after that
  void advance_to(long nanoseconds) {
    const double t = 1e-9 * static_cast<double>(nanoseconds);
    loads->set_input(integrator.updAdvancedState(), input);
    try {
      stepper.stepTo(t);
      if (!SimTK::isFinite(integrator.getAdvancedState().getY().normSqr())) failure = "a number in it is not finite";
    } catch (const std::exception& e) { failure = e.what(); }
    if (!failure.empty()) {
      failure = "helicopter: no state at t = " + std::to_string(t) + " s: " + failure;
      throw std::runtime_error(failure);
    }
    now = nanoseconds;
    motion = motion_of(body, integrator.getAdvancedState());
    const double remaining = calc_remaining(helicopter, t - input.begin);
    for (std::size_t i = 0; i < 4; ++i) input.from[i] = input.to[i] + (input.from[i] - input.to[i]) * remaining;
    input.begin = t;
    for (std::size_t i = 0; i < contact_count; ++i)
      input.anchors[i] = drag_along(helicopter.feet, foot_motion(motion, helicopter.feet.r_b[i]), input.anchors[i]);
  }

  // could any part of it touch the ground within a step?
  bool near_ground() const {
    for (const fossen::Vector3& r_b : helicopter.feet.r_b) {
      const FootMotion foot = foot_motion(motion, r_b);
      if (foot.p_n[2] > -0.02 - 2e-9 * step_nanoseconds * std::abs(foot.v_n[2])) return true;
    }
    return false;
  }

  HelicopterBody helicopter;
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter;
  SimTK::GeneralForceSubsystem forces;
  SimTK::MobilizedBody::Free body;
  Loads* loads;
  SimTK::Force::Custom force;
  SimTK::RungeKutta3Integrator integrator;
  SimTK::TimeStepper stepper;
  HelicopterInput input;
  HelicopterMotion motion;
  long now = 0;
  std::string failure;
};

HelicopterPlant::HelicopterPlant(const HelicopterBody& body, const HelicopterMotion& start,
                                 const std::array<double, 4>& settings)
    : simulation_(std::make_unique<Simulation>(body, start)) {
  simulation_->input.from = simulation_->input.to = settings;
}

HelicopterPlant::~HelicopterPlant() = default;

void HelicopterPlant::step(const HelicopterCommand& command) {
  Simulation& s = *simulation_;
  if (!s.failure.empty()) throw std::runtime_error(s.failure);
  s.input.to = command.settings;
  s.input.wind_n = command.wind_n;
  s.input.payload = command.payload;
  const long parts = s.near_ground() ? 5 : 1;
  for (long i = 0; i < parts; ++i) s.advance_to(s.now + step_nanoseconds / parts);
}

void HelicopterPlant::serialize(Archive& archive) {
  Simulation& s = *simulation_;
  archive(s.input, s.motion, s.now, s.failure);
  archive.require(s.now >= 0, "has a vehicle before the start");
  serialize_state(archive, s.integrator, 1e-9 * static_cast<double>(s.now));
}

const HelicopterMotion& HelicopterPlant::motion() const { return simulation_->motion; }

const std::array<double, 4>& HelicopterPlant::settings() const { return simulation_->input.from; }

fossen::Vector3 HelicopterPlant::specific_force() const {
  const Simulation& s = *simulation_;
  const fossen::Vector6 loads = calc_loads(s.helicopter, motion(), s.input, s.input.begin);
  return {loads[0] / s.helicopter.mass, loads[1] / s.helicopter.mass, loads[2] / s.helicopter.mass};
}

}  // namespace jarol::vehicles

#include "vehicles/helicopter/plant.h"

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

}  // namespace

class HelicopterLoads : public ForceWithInput<HelicopterInput> {
 public:
  HelicopterLoads(const SimTK::GeneralForceSubsystem& forces, const SimTK::MobilizedBody& mobilized,
                  const HelicopterBody& body)
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

struct HelicopterPlant::Simulation {
  Simulation(const HelicopterBody& properties, const HelicopterMotion& start)
      : matter(system),
        forces(system),
        body(matter.Ground(), SimTK::Transform(),
             SimTK::Body::Rigid(SimTK::MassProperties(
                 properties.mass, Vec3(0),
                 SimTK::Inertia(properties.inertia[0], properties.inertia[1], properties.inertia[2]))),
             SimTK::Transform()),
        loads(new HelicopterLoads(forces, body, properties)),  // adopted by the force
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
  }

  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter;
  SimTK::GeneralForceSubsystem forces;
  SimTK::MobilizedBody::Free body;
  HelicopterLoads* loads;
  SimTK::Force::Custom force;
  SimTK::RungeKutta3Integrator integrator;
  SimTK::TimeStepper stepper;
};

HelicopterPlant::HelicopterPlant(const HelicopterBody& properties, const HelicopterMotion& start,
                                 const std::array<double, 4>& settings)
    : HelicopterDynamics(properties, start, settings), simulation_(std::make_unique<Simulation>(body(), start)) {}

HelicopterPlant::~HelicopterPlant() = default;

HelicopterMotion HelicopterPlant::advance(const HelicopterInput& input, double, double to) {
  Simulation& s = *simulation_;
  s.loads->set_input(s.integrator.updAdvancedState(), input);
  s.stepper.stepTo(to);
  return motion_of(s.body, s.integrator.getAdvancedState());
}

void HelicopterPlant::serialize_state(Archive& archive, double time) {
  jarol::vehicles::serialize_state(archive, simulation_->integrator, time);
}

}  // namespace jarol::vehicles

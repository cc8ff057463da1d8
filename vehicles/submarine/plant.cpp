#include "vehicles/submarine/plant.h"

#include <string>

#include "distributers/interfaces/no_state.h"
#include "graph/math/euler_angles.h"
#include "vehicles/mechanics/force_with_input.h"
#include "vehicles/mechanics/frames.h"
#include "vehicles/mechanics/integrator_archive.h"

namespace jarol::vehicles {
namespace {

using SimTK::State;
using SimTK::Vec3;

SimTK::MassProperties mass_properties(const SubmarineBody& body) {
  const fossen::Matrix6& M = body.M_rb;
  const fossen::Vector3& r = body.hull.r_bg;
  return {M[0][0], Vec3(r[0], r[1], r[2]), SimTK::Inertia(M[3][3], M[4][4], M[5][5])};
}

}  // namespace

// Added mass depends on direction, which no Simbody inertia can express. So the whole equation is solved for nu_dot
// here, and Simbody's rigid body gets the one force that gives it this acceleration: M_rb nu_dot + C_rb nu.
class SubmarineHydrodynamics : public ForceWithInput<SubmarineInput> {
 public:
  SubmarineHydrodynamics(const SimTK::GeneralForceSubsystem& forces, const SimTK::MobilizedBody& mobilized,
                         const SubmarineBody& body, const Waves& waves)
      : ForceWithInput(forces, mobilized), body_(body), waves_(waves) {}

  void calcForce(const State& state, SimTK::Vector_<SimTK::SpatialVec>& body_forces, SimTK::Vector_<Vec3>&,
                 SimTK::Vector&) const override {
    const SimTK::Rotation& R_nb = mobilized_.getBodyRotation(state);
    const fossen::Vector6 nu = to_body(R_nb, mobilized_.getBodyVelocity(state));
    fossen::Vector6 tau = fossen::multiply(body_.M_rb, acceleration(state));
    const fossen::Vector6 coriolis = fossen::coriolis(body_.M_rb, nu);
    for (std::size_t i = 0; i < 6; ++i) tau[i] += coriolis[i];
    mobilized_.applyBodyForce(state, to_ground(R_nb, tau), body_forces);
  }

  fossen::Vector6 acceleration(const State& state) const {
    const SimTK::Rotation& R_nb = mobilized_.getBodyRotation(state);
    const Vec3& p_n = mobilized_.getBodyOriginLocation(state);
    const Water water = waves_.at({p_n[0], p_n[1], p_n[2]}, state.getTime());
    const Surroundings around = {{p_n[2] - water.surface, down_in_body(R_nb)},
                                 p_n[2],
                                 to_body(R_nb, water.velocity_n),
                                 to_body(R_nb, water.acceleration_n)};
    return calc_nu_dot(body_, around, to_body(R_nb, mobilized_.getBodyVelocity(state)), input(state));
  }

 private:
  SubmarineBody body_;
  Waves waves_;
};

struct SubmarinePlant::Simulation {
  Simulation(const SubmarineBody& properties, const Waves& waves, const PlantState& start)
      : matter(system),
        forces(system),
        body(matter.Ground(), SimTK::Transform(), SimTK::Body::Rigid(mass_properties(properties)), SimTK::Transform()),
        hydrodynamics(new SubmarineHydrodynamics(forces, body, properties, waves)),  // adopted by the force
        force(forces, hydrodynamics),
        integrator(system),
        stepper(system, integrator) {
    State initial = system.realizeTopology();
    const SimTK::Rotation R_nb(SimTK::BodyRotationSequence, start.eta[5], SimTK::ZAxis, start.eta[4], SimTK::YAxis,
                               start.eta[3], SimTK::XAxis);
    body.setQToFitTransform(initial, {R_nb, Vec3(start.eta[0], start.eta[1], start.eta[2])});
    body.setUToFitVelocity(
        initial, to_ground(R_nb, {start.nu[0], start.nu[1], start.nu[2], start.nu[3], start.nu[4], start.nu[5]}));
    integrator.setFixedStepSize(SubmarineMotion::step_seconds);
    stepper.initialize(initial);
  }

  // Simbody may notice a number that is not finite itself, or not at all; it must not be asked again after that
  void advance() {
    if (!failure.empty()) throw NoState(failure);
    const double t = static_cast<double>(++steps) * SubmarineMotion::step_seconds;
    try {
      stepper.stepTo(t);
      if (!SimTK::isFinite(integrator.getAdvancedState().getY().normSqr())) failure = "a number in it is not finite";
    } catch (const std::exception& e) { failure = e.what(); }
    if (failure.empty()) return;
    failure = "submarine: no state at t = " + std::to_string(t) + " s: " + failure;
    throw NoState(failure);
  }

  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter;
  SimTK::GeneralForceSubsystem forces;
  SimTK::MobilizedBody::Free body;
  SubmarineHydrodynamics* hydrodynamics;
  SimTK::Force::Custom force;
  SimTK::RungeKuttaMersonIntegrator integrator;
  SimTK::TimeStepper stepper;
  long steps = 0;
  std::string failure;
};

SubmarinePlant::SubmarinePlant(const SubmarineBody& body, const Waves& waves, const PlantState& start)
    : simulation_(std::make_unique<Simulation>(body, waves, start)) {}

SubmarinePlant::~SubmarinePlant() = default;

void SubmarinePlant::step(const SubmarineInput& input) {
  Simulation& s = *simulation_;
  s.hydrodynamics->set_input(s.integrator.updAdvancedState(), input);
  s.advance();
}

void SubmarinePlant::serialize(Archive& archive) {
  Simulation& s = *simulation_;
  archive(s.steps, s.failure);
  archive.require(s.steps >= 0, "has a vehicle before the start");
  serialize_state(archive, s.integrator, static_cast<double>(s.steps) * SubmarineMotion::step_seconds);
}

PlantState SubmarinePlant::state() const {
  const State& state = simulation_->integrator.getAdvancedState();
  const SimTK::Rotation& R_nb = simulation_->body.getBodyRotation(state);
  const Vec3& p_n = simulation_->body.getBodyOriginLocation(state);

  PlantState out;
  for (std::size_t i = 0; i < 3; ++i) out.eta[i] = p_n[static_cast<int>(i)];
  const EulerAngles attitude = euler_angles_of(R_nb);
  out.eta[3] = attitude.roll;
  out.eta[4] = attitude.pitch;
  out.eta[5] = attitude.yaw;
  out.nu = to_body(R_nb, simulation_->body.getBodyVelocity(state));
  out.nu_dot = simulation_->hydrodynamics->acceleration(state);
  return out;
}

}  // namespace jarol::vehicles

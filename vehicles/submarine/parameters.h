// Parameters of the submarine. Defaults: the LAUV (Seascout), 1.08 m, 0.15 m, 18 kg, with the coefficients of Estrela
// da Silva, Terra, Martins, Borges de Sousa, "Modeling and Simulation of the LAUV AUV", MMAR 2007, as others coded
// them.
#pragma once

#include "vehicles/mechanics/dynamics.h"
#include "vehicles/sea/sea_parameters.h"
#include "vehicles/submarine/failure_parameters.h"
#include "vehicles/submarine/power.h"
#include "vehicles/submarine/sensor_parameters.h"

namespace jarol::vehicles {

/// The rigid body. Its origin b is the centre of buoyancy; b is forward, right, down.
struct HullParameters {
  double length = 1.08;
  double diameter = 0.15;
  double mass = 18.0;
  double buoyancy = 177.58;
  double water_density = 1000.0;
  double z_g = 0.01;
  // a homogeneous spheroid of this mass and size: 2/5 m b^2 and 1/5 m (a^2 + b^2)
  double I_x = 0.04;
  double I_y = 1.07;
  double I_z = 1.07;

  static constexpr auto fields() {
    using S = HullParameters;
    return describe(field<&S::length>("m", "length over all"), field<&S::diameter>("m", "greatest diameter"),
                    field<&S::mass>("kg", "mass in air, flooded spaces excluded"),
                    field<&S::buoyancy>("N", "buoyancy when fully immersed"),
                    field<&S::water_density>("kg/m^3", "of the water in which buoyancy and all coefficients hold"),
                    field<&S::z_g>("m", "centre of gravity below the centre of buoyancy"),
                    field<&S::I_x>("kg m^2", "moment of inertia in roll, about the centre of buoyancy"),
                    field<&S::I_y>("kg m^2", "moment of inertia in pitch, about the centre of buoyancy"),
                    field<&S::I_z>("kg m^2", "moment of inertia in yaw, about the centre of buoyancy"));
  }
};

/// Added mass as Fossen writes it: force on the hull per acceleration, hence negative.
struct AddedMassParameters {
  double X_u_dot = -1.0;
  double Y_v_dot = -16.0;
  double Z_w_dot = -16.0;
  double K_p_dot = 0.0;
  double M_q_dot = -1.03;
  double N_r_dot = -1.03;
  double Y_r_dot = 0.0;
  double Z_q_dot = 0.0;

  static constexpr auto fields() {
    using S = AddedMassParameters;
    return describe(
        field<&S::X_u_dot>("kg", "surge force per surge acceleration"),
        field<&S::Y_v_dot>("kg", "sway force per sway acceleration"),
        field<&S::Z_w_dot>("kg", "heave force per heave acceleration"),
        field<&S::K_p_dot>("kg m^2", "roll moment per roll acceleration"),
        field<&S::M_q_dot>("kg m^2", "pitch moment per pitch acceleration"),
        field<&S::N_r_dot>("kg m^2", "yaw moment per yaw acceleration"),
        field<&S::Y_r_dot>("kg m", "sway force per yaw acceleration, and yaw moment per sway acceleration"),
        field<&S::Z_q_dot>("kg m", "heave force per pitch acceleration, and pitch moment per heave acceleration"));
  }
};

/// Linear damping: force per velocity, the diagonal negative.
///
/// Signs of the cross terms. A cross flow drag c(x) >= 0 along the hull meets v + r x at station x, so that
///   Y = -int c (v + r x) dx,  N = int x dY:   Y_r = N_v = -int c x dx;
/// heave meets w - q x, so that Z_q = M_w = +int c x dx. Fins aft put more of c at x < 0: Y_r, N_v > 0 and Z_q, M_w <
/// 0. Published sets disagree: one has Y_r > 0 with N_v < 0, another the reverse, so each has its force and its moment
/// from opposite ends of the hull. Taken here: the published magnitudes, all four as drag aft, as in the lift terms
/// below. Energy alone would allow every choice: the symmetric part, 23 and 9.7 beside (11.5 + 3.1)/2 or (11.5
/// - 3.1)/2, is positive definite either way.
struct LinearDampingParameters {
  double X_u = -2.4;
  double Y_v = -23.0;
  double Z_w = -23.0;
  double K_p = -0.3;
  double M_q = -9.7;
  double N_r = -9.7;
  double Y_r = 11.5;
  double Z_q = -11.5;
  double M_w = -3.1;
  double N_v = 3.1;

  static constexpr auto fields() {
    using S = LinearDampingParameters;
    return describe(
        field<&S::X_u>("N s/m", "surge force per surge"), field<&S::Y_v>("N s/m", "sway force per sway"),
        field<&S::Z_w>("N s/m", "heave force per heave"), field<&S::K_p>("N m s/rad", "roll moment per roll rate"),
        field<&S::M_q>("N m s/rad", "pitch moment per pitch rate"),
        field<&S::N_r>("N m s/rad", "yaw moment per yaw rate"), field<&S::Y_r>("N s/rad", "sway force per yaw rate"),
        field<&S::Z_q>("N s/rad", "heave force per pitch rate"), field<&S::M_w>("N s", "pitch moment per heave"),
        field<&S::N_v>("N s", "yaw moment per sway"));
  }
};

/// Quadratic damping: X_uu is X_{u|u|}, force per u|u|. Signs as in linear damping, by the same flow.
struct QuadraticDampingParameters {
  double X_uu = -2.4;
  double Y_vv = -80.0;
  double Z_ww = -80.0;
  double K_pp = -0.0006;
  double M_qq = -9.1;
  double N_rr = -9.1;
  double Y_rr = 0.3;
  double Z_qq = -0.3;
  double M_ww = -1.5;
  double N_vv = 1.5;

  static constexpr auto fields() {
    using S = QuadraticDampingParameters;
    return describe(field<&S::X_uu>("N s^2/m^2", "surge force per surge squared"),
                    field<&S::Y_vv>("N s^2/m^2", "sway force per sway squared"),
                    field<&S::Z_ww>("N s^2/m^2", "heave force per heave squared"),
                    field<&S::K_pp>("N m s^2/rad^2", "roll moment per roll rate squared"),
                    field<&S::M_qq>("N m s^2/rad^2", "pitch moment per pitch rate squared"),
                    field<&S::N_rr>("N m s^2/rad^2", "yaw moment per yaw rate squared"),
                    field<&S::Y_rr>("N s^2/rad^2", "sway force per yaw rate squared"),
                    field<&S::Z_qq>("N s^2/rad^2", "heave force per pitch rate squared"),
                    field<&S::M_ww>("N s^2/m", "pitch moment per heave squared"),
                    field<&S::N_vv>("N s^2/m", "yaw moment per sway squared"));
  }
};

/// Lift of hull and undeflected fins: Y_uv is force per |u| v. By |u| it damps going astern as well.
struct LiftParameters {
  double Y_uv = -20.6;
  double Y_ur = 3.84;
  double Z_uw = -20.6;
  double Z_uq = -3.84;
  double M_uw = -6.0;
  double M_uq = -1.53;
  double N_uv = 6.0;
  double N_ur = -1.53;

  static constexpr auto fields() {
    using S = LiftParameters;
    return describe(
        field<&S::Y_uv>("N s^2/m^2", "sway force per |u| v"), field<&S::Y_ur>("N s^2/(m rad)", "sway force per |u| r"),
        field<&S::Z_uw>("N s^2/m^2", "heave force per |u| w"),
        field<&S::Z_uq>("N s^2/(m rad)", "heave force per |u| q"), field<&S::M_uw>("N s^2/m", "pitch moment per |u| w"),
        field<&S::M_uq>("N s^2/rad", "pitch moment per |u| q"), field<&S::N_uv>("N s^2/m", "yaw moment per |u| v"),
        field<&S::N_ur>("N s^2/rad", "yaw moment per |u| r"));
  }
};

/// Four equal fins at the tail: 0 bottom, 1 port, 2 starboard, 3 top. Positive on 0 and 3 turns to port, on 1 and 2
/// noses down.
struct FinParameters {
  double x = -0.4;
  double radius = 0.08;
  double half_span = 0.04;
  double lift = 4.8;
  double drag = 3.17;
  double stall = 25.0 * degree;

  static constexpr auto fields() {
    using S = FinParameters;
    return describe(field<&S::x>("m", "position along the hull"),
                    field<&S::radius>("m", "distance of a fin's centre from the axis"),
                    field<&S::half_span>("m", "half of a fin's span; above water it loses its force over this height"),
                    field<&S::lift>("N s^2/(m^2 rad)", "lift of one fin per u|u| and angle"),
                    field<&S::drag>("N s^2/(m^2 rad^2)", "drag of one fin per u|u| and angle squared"),
                    field<&S::stall>("rad", "angle above which lift and drag stay as they are"));
  }
};

/// One propeller on the axis. Thrust = (thrust_coefficient n - advance_coefficient u) |n|, no more than max_thrust; no
/// torque on the hull.
struct ThrusterParameters {
  double x = -0.555;
  double radius = 0.05;
  double full_speed = 261.8;
  double time_constant = 0.05;
  double thrust_coefficient = 2.1e-4;
  double advance_coefficient = 0.0;
  double max_thrust = 14.4;

  static constexpr auto fields() {
    using S = ThrusterParameters;
    return describe(field<&S::x>("m", "position along the hull"), field<&S::radius>("m", "radius of the propeller"),
                    field<&S::full_speed>("rad/s", "speed at actuation 1"),
                    field<&S::time_constant>("s", "first-order lag of the speed; 0 for none"),
                    field<&S::thrust_coefficient>("N s^2/rad^2", "thrust per speed squared"),
                    field<&S::advance_coefficient>("N s^2/(m rad)", "less thrust per speed and speed ahead"),
                    field<&S::max_thrust>("N", "greatest thrust, ahead and astern"));
  }
};

struct ServoParameters {
  double limit = 45.0 * degree;
  double slew = 333.3 * degree;

  static constexpr auto fields() {
    using S = ServoParameters;
    return describe(field<&S::limit>("rad", "greatest angle to either side"),
                    field<&S::slew>("rad/s", "greatest rate"));
  }
};

/// With `vsim_compatible`: what each acceleration is a force over, whatever hull and added mass are.
struct VsimParameters {
  double M_u = 19.0;
  double M_v = 34.0;
  double M_w = 34.0;
  double I_p = 0.04;
  double I_q = 2.1;
  double I_r = 2.1;

  static constexpr auto fields() {
    using S = VsimParameters;
    return describe(
        field<&S::M_u>("kg", "effective mass in surge"), field<&S::M_v>("kg", "effective mass in sway"),
        field<&S::M_w>("kg", "effective mass in heave"), field<&S::I_p>("kg m^2", "effective inertia in roll"),
        field<&S::I_q>("kg m^2", "effective inertia in pitch"), field<&S::I_r>("kg m^2", "effective inertia in yaw"));
  }
};

/// Where and how the vehicle starts: level, without sway, heave and rates.
struct StartParameters {
  double north = 0.0;
  double east = 0.0;
  double depth = 0.0;
  double heading = 0.0;
  double surge = 0.0;

  static constexpr auto fields() {
    using S = StartParameters;
    return describe(field<&S::north>("m", "offset north of the origin"),
                    field<&S::east>("m", "offset east of the origin"),
                    field<&S::depth>("m", "depth below where it floats at rest"), field<&S::heading>("rad", "heading"),
                    field<&S::surge>("m/s", "speed ahead through the water"));
  }
};

/// What a dive that ends well keeps to.
struct DiveLimitParameters {
  double depth = 100.0;
  double tilt = 90.0 * degree;

  static constexpr auto fields() {
    using S = DiveLimitParameters;
    return describe(field<&S::depth>("m", "beyond which it has sunk"),
                    field<&S::tilt>("rad", "of its axis down from the vertical, beyond which it has capsized"));
  }
};

struct SubmarineParameters {
  Dynamics dynamics = Dynamics::simbody;
  bool vsim_compatible = false;
  VsimParameters vsim{};
  Duration command_timeout = std::chrono::seconds(2);
  HullParameters hull{};
  AddedMassParameters added_mass{};
  LinearDampingParameters linear_damping{};
  QuadraticDampingParameters quadratic_damping{};
  LiftParameters lift{};
  FinParameters fins{};
  ThrusterParameters thruster{};
  ServoParameters servos{};
  PowerParameters power{};
  SubmarineSensorParameters sensors{};
  Duration leak_at{};
  ActuatorFailureParameters failures{};
  SeaParameters sea{};
  DiveLimitParameters limits{};
  StartParameters start{};

  static constexpr auto fields() {
    using S = SubmarineParameters;
    return describe(field<&S::dynamics>("", "what integrates the motion"),
                    field<&S::vsim_compatible>("", "moves as DUNE's simulator has it, errors and all"),
                    field<&S::vsim>("", "numbers of that simulator alone"),
                    field<&S::command_timeout>("", "without a command for so long an actuator goes to rest; 0 never"),
                    field<&S::hull>("", "the rigid body and its buoyancy"), field<&S::added_mass>("", "added mass"),
                    field<&S::linear_damping>("", "damping per velocity"),
                    field<&S::quadratic_damping>("", "damping per velocity squared"),
                    field<&S::lift>("", "lift of hull and undeflected fins"), field<&S::fins>("", "the four fins"),
                    field<&S::thruster>("", "the propeller"), field<&S::servos>("", "the servos of the fins"),
                    field<&S::power>("", "battery, and warmth of the hull"), field<&S::sensors>("", "the sensors"),
                    field<&S::leak_at>("", "when water enters the hull; 0 never"),
                    field<&S::failures>("", "of fins and propeller"), field<&S::sea>("", "the sea"),
                    field<&S::limits>("", "of a dive that ends well"), field<&S::start>("", "the start"));
  }
};

}  // namespace jarol::vehicles

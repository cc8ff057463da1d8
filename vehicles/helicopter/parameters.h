// Parameters of the helicopter. Defaults: the JAviator V1, 1.1 m over the rotors, 1.5 kg, with the thrust law of the
// plant that its recorded flight was made with; the rest measured on the V2 or estimated, as helicopter.yaml says.
#pragma once

#include <numbers>

#include "graph/values/describe.h"
#include "vehicles/air/parameters.h"
#include "vehicles/helicopter/packets.h"
#include "vehicles/helicopter/sensor_parameters.h"
#include "vehicles/mechanics/dynamics.h"

namespace jarol::vehicles {

/// The rigid body. Its origin is the centre of gravity; body axes are forward, right, down.
struct FrameParameters {
  double mass = 1.5;
  double I_x = 0.0144;
  double I_y = 0.0144;
  double I_z = 0.0288;
  double drag_area = 0.03;
  double top = 0.12;

  static constexpr auto fields() {
    using S = FrameParameters;
    return describe(field<&S::mass>("kg", "mass"), field<&S::I_x>("kg m^2", "moment of inertia in roll"),
                    field<&S::I_y>("kg m^2", "moment of inertia in pitch"),
                    field<&S::I_z>("kg m^2", "moment of inertia in yaw"),
                    field<&S::drag_area>("m^2", "drag coefficient times area of everything but the rotors"),
                    field<&S::top>("m", "of its highest part above the centre of gravity"));
  }
};

/// Four equal rotors at the ends of a plus; those in front and in the rear turn clockwise seen from above. Their
/// setting follows the motor signal, from 0 to 1 at 16000, with a lag and in proportion to the battery's voltage.
struct RotorParameters {
  double arm = 0.30;
  double height = 0.05;
  double radius = 0.25;
  double full_thrust = 9.81;
  double thrust_exponent = 1.415;
  double reference_voltage = 15.887;
  double lag = 0.05;
  double torque_per_thrust = 0.024;
  double inertia = 6e-4;
  double full_speed = 255.0;
  double drag = 5e-4;
  double inflow = 2e-3;
  double ground_effect = 1.0;

  static constexpr auto fields() {
    using S = RotorParameters;
    return describe(
        field<&S::arm>("m", "distance of a rotor's axis from the centre"),
        field<&S::height>("m", "of the rotors above the centre of gravity"),
        field<&S::radius>("m", "radius of a rotor"),
        field<&S::full_thrust>("N", "thrust of one rotor at setting 1, far from the ground"),
        field<&S::thrust_exponent>("", "thrust is full_thrust times the setting to this power"),
        field<&S::reference_voltage>("V", "voltage at which signal 16000 is setting 1"),
        field<&S::lag>("s", "first-order lag of the setting"),
        field<&S::torque_per_thrust>("m", "drag torque of a rotor per thrust"),
        field<&S::inertia>("kg m^2", "moment of inertia of one rotor about its axis"),
        field<&S::full_speed>("rad/s", "speed of a rotor at setting 1"),
        field<&S::drag>("N s^2/(m rad)", "force against flow in the rotor's plane, per speed of flow and of rotor"),
        field<&S::inflow>("N s^2/(m rad)", "thrust lost to flow against it, per speed of flow and of rotor"),
        field<&S::ground_effect>("", "part of the Cheeseman-Bennett gain of thrust near the ground"));
  }
};

/// Four feet, below the arms, and how the ground carries them; it carries rotors and top in the same way.
struct FeetParameters {
  double radius = 0.20;
  double height = 0.20;
  double stiffness = 2500.0;
  double dissipation = 10.0;
  double friction = 0.8;

  static constexpr auto fields() {
    using S = FeetParameters;
    return describe(field<&S::radius>("m", "distance of a foot from the centre"),
                    field<&S::height>("m", "of the centre of gravity above the feet"),
                    field<&S::stiffness>("N/m", "of one foot, upwards and sideways"),
                    field<&S::dissipation>("s/m", "growth of the force per speed of compression"),
                    field<&S::friction>("", "friction between foot and ground"));
  }
};

/// Current of the rotors: full_current at full thrust of all, less by a power of the thrust. The voltage falls with the
/// charge used, from full to empty, and with the current; when all charge is used the pack disconnects itself, and the
/// motors get nothing. Electronics have a cell of their own then.
struct BatteryParameters {
  double full = 16.0;
  double empty = 13.2;
  double capacity = 6.3;
  double resistance = 0.02;
  double electronics = 0.7;
  double full_current = 27.7;
  double current_exponent = 1.76;

  static constexpr auto fields() {
    using S = BatteryParameters;
    return describe(
        field<&S::full>("V", "voltage without load when full"),
        field<&S::empty>("V", "the same when all charge is used; between them it falls with that, and then to 0"),
        field<&S::capacity>("A h", "charge"), field<&S::resistance>("Ohm", "of cells and wires"),
        field<&S::electronics>("A", "current of everything but the motors"),
        field<&S::full_current>("A", "of the four motors at full thrust"),
        field<&S::current_exponent>("", "current grows with thrust to this power"));
  }
};

/// What it carries below its centre of gravity, and drops.
struct PayloadParameters {
  double mass = 0.0;
  double at = 1e9;
  double chance = 0.0;

  static constexpr auto fields() {
    using S = PayloadParameters;
    return describe(field<&S::mass>("kg", "carried in the centre of gravity"),
                    field<&S::at>("s", "when it is dropped, or may be"),
                    field<&S::chance>("1/s", "rate at which it is dropped from then on; 0: it is dropped then"));
  }
};

/// What a flight that ends well keeps to.
struct LimitParameters {
  double touch_speed = 2.0;
  double tilt = std::numbers::pi / 2;
  double take_off_signal = 8000.0;
  double take_off_time = 1.5;

  static constexpr auto fields() {
    using S = LimitParameters;
    return describe(field<&S::touch_speed>("m/s", "speed down of a foot at the ground, beyond which it has crashed"),
                    field<&S::tilt>("rad", "of its axis from the vertical, beyond which it has capsized"),
                    field<&S::take_off_signal>("", "mean motor signal that is an order to take off, 0 to 16000"),
                    field<&S::take_off_time>("s", "of that order, after which it has to have left the ground"));
  }
};

/// Level and at rest, standing or in the air.
struct LiftOffParameters {
  double north = 0.0;
  double east = 0.0;
  double altitude = 0.0;
  double heading = 0.0;
  double signal = 0.0;

  static constexpr auto fields() {
    using S = LiftOffParameters;
    return describe(field<&S::north>("m", "offset north of the origin"),
                    field<&S::east>("m", "offset east of the origin"),
                    field<&S::altitude>("m", "above where it stands"), field<&S::heading>("rad", "heading"),
                    field<&S::signal>("", "motor signals that the rotors have followed, 0 to 16000"));
  }
};

struct HelicopterParameters {
  Dynamics dynamics = Dynamics::simbody;
  FrameParameters frame{};
  RotorParameters rotors{};
  FeetParameters feet{};
  BatteryParameters battery{};
  AirParameters air{};
  SensorParameters sensors{};
  NoiseParameters noise{};
  FailureParameters failures{};
  PacketParameters packets{};
  PayloadParameters payload{};
  LimitParameters limits{};
  LiftOffParameters start{};

  static constexpr auto fields() {
    using S = HelicopterParameters;
    return describe(field<&S::dynamics>("", "what integrates its motion"), field<&S::frame>("", "the rigid body"),
                    field<&S::rotors>("", "the four rotors"), field<&S::feet>("", "the four feet"),
                    field<&S::battery>("", "the battery"), field<&S::air>("", "the air"),
                    field<&S::sensors>("", "places of the sensors"), field<&S::noise>("", "of the sensors"),
                    field<&S::failures>("", "of sensors and motors"),
                    field<&S::packets>("", "between it and whoever steers it"),
                    field<&S::payload>("", "what it carries and drops"),
                    field<&S::limits>("", "of a flight that ends well"), field<&S::start>("", "the start"));
  }
};

}  // namespace jarol::vehicles

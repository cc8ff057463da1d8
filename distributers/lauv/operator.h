// The submarine's operator at a console that speaks IMC, as LSTS' Neptus does.
#pragma once

#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "distributers/interfaces/distributer.h"
#include "distributers/messages/imc.h"
#include "graph/values/type_of.h"
#include "tasks/values/instruments.h"
#include "tasks/values/lauv.h"

namespace jarol::distributers {
namespace imc = messages::imc;

/// Defaults: what DUNE does as a simulator, and the vehicle of that name that Neptus knows.
struct LauvOperatorParameters {
  String name = "lauv-simulator-1";
  double latitude = 41.1850 * std::numbers::pi / 180;
  double longitude = -8.7062 * std::numbers::pi / 180;
  double full_thrust = 0.7;
  double full_rate = 40 * std::numbers::pi / 180;
  double button_rate = 0.1;
  double silence = 2;

  static constexpr auto fields() {
    using P = LauvOperatorParameters;
    return describe(field<&P::name>("", "by which the vehicle announces itself"),
                    field<&P::latitude>("rad", "of the origin, WGS-84"),
                    field<&P::longitude>("rad", "of the origin, WGS-84"),
                    field<&P::full_thrust>("", "thrust at the end of its axis, 0 to 1"),
                    field<&P::full_rate>("rad/s", "rate of turn at the end of the axis of heading"),
                    field<&P::button_rate>("1/s", "thrust per time while its button is held"),
                    field<&P::silence>("s", "of a hand that steers, after which thrust and rate are 0"));
  }
};

/// The newest command wins: a Desired... has the autopilot steer, a RemoteActions the operator's hand, an Abort stops
/// the propeller, so that the vehicle comes up. An Abort, and the stop of a plan or maneuver, also has an alarm of the
/// vehicle forgotten whose cause is gone; until then its state is an error. What is asked is answered at the next
/// instant.
class LauvOperator {
 public:
  static constexpr std::string_view summary = "the submarine's operator, over IMC";
  static constexpr bool is_vehicle = false;
  using Param = LauvOperatorParameters;

  struct In {
    Newest<tasks::Setpoint> setpoint;
    Newest<tasks::Actuation> actuation;
    Computed<tasks::Contact> contact;
    static constexpr auto fields() {
      return describe(channel<&In::setpoint>("commanded depth, heading and speed"),
                      channel<&In::actuation>("propeller and fins, steered by hand"),
                      channel<&In::contact>("how long the operator was not heard, and demands of a stop"));
    }
  };
  struct Out {
    tasks::VehicleReport report;
    tasks::Motion motion;
    static constexpr auto fields() {
      return describe(channel<&Out::report>("depth, pitch, heading and speed reached"),
                      channel<&Out::motion>("the vehicle's motion as it came"));
    }
  };

  static const messages::MessageSet& message_set() { return imc::message_set(); }
  static constexpr auto handlers() {
    using O = LauvOperator;
    return handle(on<imc::DesiredZ>(&O::desired_z), on<imc::DesiredHeading>(&O::desired_heading),
                  on<imc::DesiredHeadingRate>(&O::desired_heading_rate), on<imc::DesiredSpeed>(&O::desired_speed),
                  on<imc::SetThrusterActuation>(&O::set_thruster), on<imc::SetServoPosition>(&O::set_servo),
                  on<imc::RemoteActions>(&O::remote_actions), on<imc::Abort>(&O::abort),
                  on<imc::PlanControl>(&O::plan_control), on<imc::VehicleCommand>(&O::vehicle_command),
                  on<imc::RemoteActionsRequest>(&O::actions_request), on<imc::EntityList>(&O::entity_list),
                  compute<&In::contact>(&O::contact), send<&Out::report>(&O::send_report),
                  send<&Out::motion>(&O::send_motion));
  }

  explicit LauvOperator(const Param& parameters) : parameters_(parameters) {}

  void any_message() { heard_ = now_; }
  void reach(Duration instant, messages::Receiver& system);
  void announce(Duration instant, messages::Receiver& all);
  void listen_at(const std::string& address) { address_ = address; }
  std::uint64_t non_finite_inputs() const { return non_finite_inputs_; }

  In in;

 private:
  enum class Mode { service, external, teleoperation, error };

  void desired_z(const imc::DesiredZ& z);
  void desired_heading(const imc::DesiredHeading& heading);
  void desired_heading_rate(const imc::DesiredHeadingRate& rate);
  void desired_speed(const imc::DesiredSpeed& speed);
  void set_thruster(const imc::SetThrusterActuation& thruster);
  void set_servo(const imc::SetServoPosition& servo);
  void remote_actions(const imc::RemoteActions& message);
  void abort(const imc::Abort&);
  void plan_control(const imc::PlanControl& plan);
  void vehicle_command(const imc::VehicleCommand& command);
  void actions_request(const imc::RemoteActionsRequest& request);
  void entity_list(const imc::EntityList& list);
  tasks::Contact contact();
  void send_report(const tasks::VehicleReport& report, messages::Receiver& system);
  void send_motion(const tasks::Motion& motion, messages::Receiver& system);
  void send_state(const tasks::Motion& motion, messages::Receiver& system) const;

  bool is_finite(double value);  // else that is counted
  bool use_autopilot();
  void start_teleoperation();
  void demand_stop();
  void stop();
  void set_mode(Mode mode);
  std::string execute(std::uint32_t maneuver);
  void refuse(const std::string& text);
  template <class M>
  void answer(const M& message) {
    answers_.emplace_back(messages::refer_to(message));
  }

  void steer_by_hand(Duration instant);
  void send_vehicle_state(messages::Receiver& system) const;

  LauvOperatorParameters parameters_;
  std::string address_;
  Duration now_{};
  Mode mode_ = Mode::service;
  std::uint64_t non_finite_inputs_ = 0;

  // of the hand that steers
  std::optional<Duration> hand_heard_;  // its last RemoteActions
  double heading_axis_ = 0, thrust_axis_ = 0;
  int button_ = 0;      // 1: accelerate, -1: decelerate
  bool let_go_ = true;  // since an abort: it counts again after a silence

  std::optional<Duration> aborted_;
  Duration heard_{};
  std::uint32_t stops_ = 0;  // demanded by the operator
  tasks::Alarm alarm_ = tasks::Alarm::none;
  double heading_ = 0;        // of the vehicle, as told last
  bool motion_sent_ = false;  // by channel `motion`, which has more than `report`
  bool mode_changed_ = true;
  std::optional<std::int64_t> second_;  // told for it
  std::optional<Duration> announced_;
  std::vector<messages::Message> answers_;
};

}  // namespace jarol::distributers

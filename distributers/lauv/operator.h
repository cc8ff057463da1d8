// The submarine's operator at a console that speaks IMC, as LSTS' Neptus does.
#pragma once

#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "distributers/interfaces/any_distributer.h"
#include "distributers/lauv/tuple_list.h"
#include "graph/registry.h"
#include "tasks/values/instruments.h"
#include "tasks/values/lauv.h"

namespace jarol::distributers {

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
class LauvOperator : public AnyDistributer {
 public:
  static DistributerClass describe_class();

  explicit LauvOperator(const LauvOperatorParameters& parameters) : parameters_(parameters) {}

  const messages::MessageSet& message_set() const override;
  void listen_at(const std::string& address) override { address_ = address; }
  void receive(messages::MessageRef message) override;
  void reach(Duration instant, messages::Receiver& system) override;
  void announce(Duration instant, messages::Receiver& all) override;
  std::uint64_t non_finite_inputs() const override { return non_finite_inputs_; }
  bool take(std::size_t channel, void* value) override;
  void hand_over(std::size_t channel, const void* value, messages::Receiver& system) override;

 private:
  enum class Mode { service, external, teleoperation, error };

  void receive_reference(messages::MessageRef message);
  void receive_plan(messages::MessageRef message);
  void receive_actuation(messages::MessageRef message);
  void receive_question(messages::MessageRef message);
  void receive_actions(const TupleList& actions);
  void receive_abort();
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
  void tell_state(messages::Receiver& system) const;

  LauvOperatorParameters parameters_;
  std::string address_;
  Duration now_{};
  Mode mode_ = Mode::service;
  tasks::Setpoint setpoint_;
  tasks::Actuation actuation_;
  bool setpoint_fresh_ = false, actuation_fresh_ = false;
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
  bool motion_told_ = false;  // by channel `motion`, which tells more than `report`
  bool mode_changed_ = true;
  std::optional<std::int64_t> second_;  // told for it
  std::optional<Duration> announced_;
  std::vector<messages::Message> answers_;
};

}  // namespace jarol::distributers

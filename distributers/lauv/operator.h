// The submarine's operator at a console that speaks IMC, as LSTS' Neptus does.
#pragma once

#include <atomic>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "distributers/interfaces/distributer.h"
#include "distributers/lauv/answered_requests.h"
#include "distributers/lauv/plan_run.h"
#include "distributers/lauv/plan_store.h"
#include "distributers/messages/imc.h"
#include "distributers/messages/imc_announce.h"
#include "graph/values/type_of.h"
#include "tasks/values/guidance.h"
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
  FlightLimits limits{};
  HeadwayLimits headway{};

  static constexpr auto fields() {
    using P = LauvOperatorParameters;
    return describe(field<&P::name>("", "by which the vehicle announces itself"),
                    field<&P::latitude>("rad", "of the origin, WGS-84, until the vehicle reports where it has its own"),
                    field<&P::longitude>("rad", "of the origin, WGS-84"),
                    field<&P::full_thrust>("", "thrust at the end of its axis, 0 to 1"),
                    field<&P::full_rate>("rad/s", "rate of turn at the end of the axis of heading"),
                    field<&P::button_rate>("1/s", "thrust per time while its button is held"),
                    field<&P::silence>("s", "of a hand that steers, after which thrust and rate are 0"),
                    field<&P::limits>("", "of plans: what exceeds them is refused"),
                    field<&P::headway>("", "without which a plan is given up"));
  }
};

/// The newest command wins: a Desired... has the autopilot steer, a RemoteActions the operator's hand, a PlanControl a
/// plan, an Abort stops the propeller, so that the vehicle comes up. An Abort, and the stop of a plan or maneuver, also
/// has an alarm of the vehicle forgotten whose cause is gone; until then its state is an error, without control loops.
/// While a plan runs a stick that rests counts for nothing, as the vehicle's DUNE has it: only in its Teleoperation
/// does a hand steer, and nobody has to be heard. Astern it is driven at the surface only. Another who has the link now
/// is the operator from when it commands: until then it is the one before that is silent. What is asked is answered at
/// the next instant. While the vehicle is brought to rest at the end of a run no plan begins; a stop is obeyed in place
/// of what brings it there. No plan goes by places while nobody knows where the vehicle is, nor by altitudes where it
/// has no altimeter.
class LauvOperator {
 public:
  static constexpr std::string_view summary = "the submarine's operator, over IMC";
  static constexpr bool is_vehicle = false;
  using Param = LauvOperatorParameters;

  struct In {
    Newest<tasks::Setpoint> setpoint;
    Newest<tasks::Actuation> actuation;
    Newest<tasks::Leg> leg;
    Computed<tasks::Contact> contact;
    static constexpr auto fields() {
      return describe(channel<&In::setpoint>("commanded depth, heading and speed"),
                      channel<&In::actuation>("propeller and fins, steered by hand"),
                      channel<&In::leg>("what of its plan the vehicle is to follow"),
                      channel<&In::contact>("how long the operator was not heard, and demands of a stop"));
    }
  };
  struct Out {
    tasks::VehicleReport report;
    tasks::Motion motion;
    tasks::Stream stream;
    tasks::Progress progress;
    tasks::Instruments instruments;
    static constexpr auto fields() {
      return describe(channel<&Out::report>("depth, pitch, heading and speed reached"),
                      channel<&Out::motion>("the vehicle's motion as it came"),
                      channel<&Out::stream>("how the water moves, as the vehicle estimates it"),
                      channel<&Out::progress>("how far it is on a leg of its plan"),
                      channel<&Out::instruments>(
                          "altitude and origin, and whether its place is known, of what its instruments report"));
    }
  };

  static const messages::MessageSet& message_set() { return imc::message_set(); }
  static constexpr auto handlers() {
    using O = LauvOperator;
    return handle(
        on<imc::DesiredZ>(&O::desired_z), on<imc::DesiredHeading>(&O::desired_heading),
        on<imc::DesiredHeadingRate>(&O::desired_heading_rate), on<imc::DesiredSpeed>(&O::desired_speed),
        on<imc::SetThrusterActuation>(&O::set_thruster), on<imc::SetServoPosition>(&O::set_servo),
        on<imc::RemoteActions>(&O::remote_actions), on<imc::Abort>(&O::abort), on<imc::PlanControl>(&O::plan_control),
        on<imc::PlanDB>(&O::plan_db), on<imc::VehicleCommand>(&O::vehicle_command), on<imc::Reference>(&O::reference),
        on<imc::TeleoperationDone>(&O::teleoperation_done), on<imc::RemoteActionsRequest>(&O::actions_request),
        on<imc::EntityList>(&O::entity_list), on<imc::QueryEntityState>(&O::query_entity_state),
        on<imc::QueryEntityInfo>(&O::query_entity_info), on<imc::LogBookControl>(&O::log_book_control),
        compute<&In::contact>(&O::contact), send<&Out::report>(&O::send_report), send<&Out::motion>(&O::send_motion),
        send<&Out::stream>(&O::send_stream), send<&Out::progress>(&O::note_progress),
        send<&Out::instruments>(&O::note_instruments));
  }

  explicit LauvOperator(const Param& parameters)
      : parameters_(parameters), origin_{parameters.latitude, parameters.longitude}, plan_(parameters.headway) {}

  void any_message(const messages::MessageRef& message);
  void peer_changed();
  void reach(Duration instant, messages::Receiver& system);
  void announce(Duration instant, messages::Receiver& all);
  void listen_at(const std::string& address) { address_ = address; }
  std::uint64_t non_finite_inputs() const { return non_finite_inputs_; }
  void ending();
  bool overrides_end() const { return overrides_end_.load(std::memory_order_relaxed); }

  In in;

 private:
  enum class Mode { service, external, teleoperation, plan, error };
  using From = messages::MessageRef;  // whose header says who asks

  void desired_z(const imc::DesiredZ& z);
  void desired_heading(const imc::DesiredHeading& heading);
  void desired_heading_rate(const imc::DesiredHeadingRate& rate);
  void desired_speed(const imc::DesiredSpeed& speed);
  void set_thruster(const imc::SetThrusterActuation& thruster);
  void set_servo(const imc::SetServoPosition& servo);
  void remote_actions(const imc::RemoteActions& message);
  void abort(const imc::Abort&);
  void plan_control(const imc::PlanControl& plan, const From& from);
  void plan_db(const imc::PlanDB& request, const From& from);
  void vehicle_command(const imc::VehicleCommand& command, const From& from);
  void reference(const imc::Reference& reference, const From& from);
  void teleoperation_done(const imc::TeleoperationDone&);
  void actions_request(const imc::RemoteActionsRequest& request, const From& from);
  void entity_list(const imc::EntityList& list, const From& from);
  void query_entity_state(const imc::QueryEntityState&, const From& from);
  void query_entity_info(const imc::QueryEntityInfo& query, const From& from);
  void log_book_control(const imc::LogBookControl& control, const From& from);
  tasks::Contact contact();
  void send_report(const tasks::VehicleReport& report, messages::Receiver& system);
  void note_fins(tasks::FinCheck fins);
  void send_motion(const tasks::Motion& motion, messages::Receiver& system);
  void send_stream(const tasks::Stream& stream, messages::Receiver& system);
  void note_progress(const tasks::Progress& progress, messages::Receiver& system);
  void note_instruments(const tasks::Instruments& instruments, messages::Receiver& system);
  void send_state(const tasks::Motion& motion, messages::Receiver& system) const;

  bool is_finite(double value);  // else that is counted
  void note_command();
  bool use_autopilot();
  bool may_go_astern() const;
  void stop_astern();
  void start_teleoperation();
  void demand_stop();
  void stop();
  void set_mode(Mode mode);
  void move_origin(const Origin& to);
  double altitude() const;  // m over the sea floor; negative: not known
  bool has_altimeter() const { return altitude_.count >= 0; }

  // of plans; each returns why not, or nothing
  std::string start_plan(const imc::PlanControl& request, std::uint16_t who);
  std::string find_unflyable(const imc::PlanSpecification& plan, const Origin& origin) const;
  std::string load_plan(const imc::PlanControl& request, std::uint16_t who);
  std::string execute(Plan plan);
  void end_plan(const std::string& why);
  void follow_plan();
  void finish_teleoperation();

  // what goes to the operator's log book, and stays in ours
  void log(std::uint8_t type, const std::string& text);
  void refuse(const std::string& text) { log(imc::LogBookEntry::Type::WARNING, text); }
  // the same to all, or to who has asked
  template <class M>
  void answer(const M& message, std::uint8_t entity) {
    answers_.push_back({messages::Message(messages::refer_to(message)), {.src_ent = entity}});
  }
  template <class M>
  void answer(const M& message, std::uint8_t entity, const From& to) {
    answer(message, entity);
    address_last(to);
  }
  void address_last(const From& to);
  bool answer_again(const std::optional<RequestId>& request, const From& to);  // false: it was not answered before

  void steer_by_hand(Duration instant);
  void send_vehicle_state(messages::Receiver& system) const;
  void send_plan_state(messages::Receiver& system) const;
  imc::EntityState state_of(std::uint8_t entity) const;

  LauvOperatorParameters parameters_;
  Origin origin_;  // that of the vehicle, once it knows where it is
  std::string address_;
  Duration now_{};
  Mode mode_ = Mode::service;
  std::uint64_t non_finite_inputs_ = 0;

  // of the hand that steers
  std::optional<Duration> hand_heard_;  // its last RemoteActions
  double heading_axis_ = 0, thrust_axis_ = 0;
  int button_ = 0;  // 1: accelerate, -1: decelerate
  bool button_refused_ = false;
  bool let_go_ = true;  // since an abort: it counts again after a silence

  bool ending_ = false;
  std::atomic<bool> overrides_end_{false};

  std::optional<Duration> aborted_;
  Duration heard_{};
  static constexpr std::uint16_t nobody = 0xffff;
  std::uint16_t speaker_ = nobody;          // id of who has sent the message at hand
  std::optional<std::uint16_t> commander_;  // and the last command
  bool has_commanded_ = true;  // who has the link now; else the vehicle goes by what another one has commanded
  std::uint32_t stops_ = 0;    // demanded by the operator
  tasks::Alarm alarm_ = tasks::Alarm::none;
  tasks::FinCheck fins_ = tasks::FinCheck::checked;
  double heading_ = 0;                          // of the vehicle, as reported last
  double depth_ = 0;                            // likewise
  double wanted_depth_ = 0, wanted_speed_ = 0;  // by the last DesiredZ and DesiredSpeed, whether it goes there or not
  tasks::Motion motion_;                        // likewise
  tasks::Stream stream_;                        // likewise
  tasks::Reading altitude_;                     // likewise
  Duration altitude_at_{};                      // when it came
  bool placeless_ = false;                      // it has reported, and no fix yet
  bool motion_sent_ = false;                    // by channel `motion`, which has more than `report`
  bool mode_changed_ = true;
  std::optional<std::int64_t> second_;  // told for it
  messages::imc::AnnounceTimer announce_timer_;
  struct Answer {
    messages::Message message;
    imc::Header header;
  };
  std::vector<Answer> answers_;
  AnsweredRequests answered_;
  std::vector<imc::LogBookEntry> log_book_;  // the newest, as many as are kept

  PlanRun plan_;
  PlanStore plans_;
  std::optional<imc::PlanSpecification> loaded_;
  double maneuver_start_ = 0, last_error_at_ = 0;  // s since 1970, for the operator's eyes
  std::string last_error_;
};

}  // namespace jarol::distributers

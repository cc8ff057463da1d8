// The helicopter's operator as the core sees it: commands come in, reports go out.
#pragma once

#include <Eigen/Core>

#include "distributers/interfaces/distributer.h"
#include "distributers/javiator/trim_file.h"
#include "distributers/messages/javiator.h"
#include "graph/values/type_of.h"
#include "tasks/values/gains.h"
#include "tasks/values/javiator.h"

namespace jarol::distributers {
namespace javiator = messages::javiator;

struct JaviatorOperatorParameters {
  String trim_file;

  static constexpr auto fields() {
    return describe(field<&JaviatorOperatorParameters::trim_file>(
        "", "where the trim is kept from one run to the next; none: each begins without"));
  }
};

/// Speaks with the JAviator's control terminal as its flight controller does: GroundReport and TraceData out, which the
/// terminal answers with CommandData; switches, trim and shut-down in. Gains and idle signal that it sends are for the
/// JAviator's own laws. Over UDP, a SwitchState that comes first of a new peer is a hello and switches nothing. Where a
/// trim file is named, the trim is read from it at the start and kept in it when the run ends, as the JAviator's
/// controller does.
class JaviatorOperator {
 public:
  static constexpr std::string_view summary = "the helicopter's operator, over the JAviator's protocol";
  static constexpr bool is_vehicle = false;
  using Param = JaviatorOperatorParameters;

  struct In {
    Computed<tasks::PilotCommand> command;
    Newest<tasks::OperatorGains> gains;
    static constexpr auto fields() {
      return describe(channel<&In::command>("attitude, altitude, position and switches"),
                      channel<&In::gains>("of the JAviator's own laws"));
    }
  };
  struct Out {
    tasks::HelicopterReport report;
    static constexpr auto fields() { return describe(channel<&Out::report>("motion, motor signals and state")); }
  };

  static const messages::MessageSet& message_set() { return javiator::message_set(); }
  static constexpr auto handlers() {
    using O = JaviatorOperator;
    return handle(on<javiator::CommandData>(&O::command_data), on<javiator::SwitchState>(&O::switch_state),
                  on<javiator::SwitchMode>(&O::switch_mode), on<javiator::ShutDown>(&O::shut_down),
                  on<javiator::StoreTrim>(&O::store_trim), on<javiator::ClearTrim>(&O::clear_trim),
                  on<javiator::RollPitchParams>(&O::lean_gains), on<javiator::YawParams>(&O::yaw_gains),
                  on<javiator::AltParams>(&O::altitude_gains), on<javiator::XYParams>(&O::position_gains),
                  on<javiator::IdleLimit>(&O::idle_limit), compute<&In::command>(&O::take_command),
                  send<&Out::report>(&O::send_report));
  }

  /// Throws InputError if the trim file is none.
  explicit JaviatorOperator(const Param& parameters = {});

  void peer_changed() { hello_due_ = true; }
  void reach(Duration instant, messages::Receiver&) { now_ = instant; }
  void finish();

  In in;

 private:
  void command_data(const javiator::CommandData& c);
  void switch_state(const javiator::SwitchState&);
  void switch_mode(const javiator::SwitchMode&) { press(command_.mode_switches); }
  void shut_down(const javiator::ShutDown&) { press(command_.shut_downs); }
  void store_trim(const javiator::StoreTrim&) { press(command_.trim_stores); }
  void clear_trim(const javiator::ClearTrim&) { press(command_.trim_clears); }
  /// Who sends anything else has said its hello, or has it lost: the next SwitchState is meant.
  void press(std::uint32_t& key) {
    ++key;
    hello_due_ = false;
  }
  void lean_gains(const javiator::RollPitchParams& p);
  void yaw_gains(const javiator::YawParams& p);
  void altitude_gains(const javiator::AltParams& p);
  void position_gains(const javiator::XYParams& p);
  void idle_limit(const javiator::IdleLimit& limit);
  /// One at each instant, for silence is one, too: it is heard if CommandData came since the instant before.
  tasks::PilotCommand take_command();
  void send_report(const tasks::HelicopterReport& report, messages::Receiver& system);

  std::string trim_file_;
  Trim kept_, trim_;  // at the start, and in the newest report
  tasks::PilotCommand command_{.heard = false};
  bool hello_due_ = false;

  Duration now_{}, taken_{}, period_{}, reported_{};
  Eigen::Vector3d rates_ = Eigen::Vector3d::Zero();  // of roll, pitch, yaw in the report before, mrad/s
  std::uint8_t state_;                               // in the report before
  std::uint16_t reports_ = 0;
};

}  // namespace jarol::distributers

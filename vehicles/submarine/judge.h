// Where a submarine truly is, as its operator would name it, and what no dive should have: plain numbers in.
#pragma once

#include <optional>

#include "distributers/interfaces/vehicle.h"
#include "graph/values/describe.h"
#include "vehicles/submarine/parameters.h"

namespace jarol::vehicles {

struct SubmarineTruth {
  double depth = 0, heading = 0, speed = 0;
  double roll = 0, pitch = 0;
  double x = 0, y = 0;
  double altitude = 0;
  double sinking = 0, turn_rate = 0;

  static constexpr auto fields() {
    using S = SubmarineTruth;
    return describe(field<&S::depth>("m", "below still water"),
                    field<&S::heading>("rad", "clockwise from north, -pi to pi"),
                    field<&S::speed>("m/s", "ahead through the water"), field<&S::roll>("rad", "to starboard"),
                    field<&S::pitch>("rad", "nose up"), field<&S::x>("m", "north of the origin"),
                    field<&S::y>("m", "east of the origin"), field<&S::altitude>("m", "above the sea floor"),
                    field<&S::sinking>("m/s", "downwards"), field<&S::turn_rate>("rad/s", "about its axis down"));
  }
};

class SubmarineJudge {
 public:
  SubmarineJudge(const SubmarineParameters& parameters, const VehicleState& start);

  /// A step has brought it here.
  void look(std::chrono::nanoseconds instant, const VehicleState& state);

  const SubmarineTruth& truth() const { return truth_; }
  const std::optional<Mishap>& mishap() const { return mishap_; }
  /// As of a vehicle.
  std::string unrest() const;

  void serialize(Archive& archive) { archive(truth_, mishap_); }

 private:
  void report_truth(const VehicleState& state);

  SubmarineParameters parameters_;
  SubmarineTruth truth_;
  std::optional<Mishap> mishap_;
};

}  // namespace jarol::vehicles

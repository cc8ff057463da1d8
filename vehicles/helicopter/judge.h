// Looks at a helicopter's true motion for what no flight should have: plain numbers in.
#pragma once

#include <optional>

#include "distributers/interfaces/vehicle.h"
#include "vehicles/helicopter/body.h"
#include "vehicles/helicopter/parameters.h"
#include "vehicles/helicopter/truth.h"

namespace jarol::vehicles {

class HelicopterJudge {
 public:
  HelicopterJudge(const HelicopterParameters& parameters, const HelicopterMotion& start);

  /// A step has brought it here, with these settings of its rotors.
  void look(std::chrono::nanoseconds instant, const HelicopterMotion& motion, const std::array<double, 4>& settings);

  /// Of the newest motion; found when it is asked for.
  const HelicopterTruth& truth() const {
    if (!is_found_) find_truth();
    return truth_;
  }
  std::optional<Mishap> mishap() const;
  /// As of a vehicle.
  std::string unrest() const;

  void serialize(Archive& archive);

 private:
  void find_truth() const;
  double height() const;
  void meet_ground(std::chrono::nanoseconds instant, const HelicopterMotion& motion, std::size_t part);
  void find_capsize(std::chrono::nanoseconds instant);

  HelicopterBody body_;
  LimitParameters limits_;
  double upright_;  // cosine of a tilt that is surely within its limit
  HelicopterMotion start_;
  double start_yaw_;
  HelicopterMotion last_;
  mutable HelicopterTruth truth_;  // its touch_down and impact always, the rest where it is found
  mutable bool is_found_ = false;
  std::optional<Mishap> mishap_;
  bool has_flown_ = false;
  std::chrono::nanoseconds last_instant_{};
  double driven_ = 0;  // s, how long on the ground its rotors were ordered to lift it
};

}  // namespace jarol::vehicles

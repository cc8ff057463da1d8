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

  const HelicopterTruth& truth() const { return truth_; }
  std::optional<Mishap> mishap() const;

  void serialize(Archive& archive) { archive(start_, last_, truth_, mishap_, has_flown_, last_instant_, driven_); }

 private:
  void tell_truth(const HelicopterMotion& motion);
  void meet_ground(std::chrono::nanoseconds instant, const HelicopterMotion& motion, std::size_t part);
  void find_capsize(std::chrono::nanoseconds instant);

  HelicopterBody body_;
  LimitParameters limits_;
  HelicopterMotion start_;
  HelicopterMotion last_;
  HelicopterTruth truth_;
  std::optional<Mishap> mishap_;
  bool has_flown_ = false;
  std::chrono::nanoseconds last_instant_{};
  double driven_ = 0;  // s, how long on the ground its rotors were ordered to lift it
};

}  // namespace jarol::vehicles

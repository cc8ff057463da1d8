// The submarine's battery and what heats its hull.
#pragma once

#include "graph/values/archive.h"
#include "graph/values/describe.h"

namespace jarol::vehicles {

struct PowerParameters {
  double full = 25.2;
  double empty = 18.0;
  double resistance = 0.1;
  double capacity = 20.0;
  double charge = 1.0;
  double hotel = 1.0;
  double propulsion = 6.0;
  double heating = 3.0;
  double heating_time = 600.0;

  static constexpr auto fields() {
    using S = PowerParameters;
    return describe(
        field<&S::full>("V", "voltage of the full battery without load"),
        field<&S::empty>("V", "the same when all charge is used; between them it falls with that, and then to 0"),
        field<&S::resistance>("Ohm", "inside the battery"), field<&S::capacity>("A h", "charge of the full battery"),
        field<&S::charge>("", "part of it that is left at the start").in(0, 1),
        field<&S::hotel>("A", "what everything but the propeller draws"),
        field<&S::propulsion>("A", "what the propeller draws at full speed; grows with its cube"),
        field<&S::heating>("K/A", "in the end the hull is warmer than the water by this, per current"),
        field<&S::heating_time>("s", "after which it is so to two thirds"));
  }
};

class Power {
 public:
  /// Throws InputError if no battery can have these parameters.
  explicit Power(const PowerParameters& parameters);

  /// A propeller at this part of its full speed, for some seconds.
  void draw(double part, double seconds);

  /// All of the charge is used, and the pack disconnects itself: its terminals have no voltage, propeller and servos
  /// get none any more; instruments have a cell of their own.
  bool is_flat() const { return used_ >= 3600.0 * parameters_.capacity; }

  double current() const { return current_; }
  double voltage() const;
  double warmth() const { return warmth_; }  // K above the water

  void serialize(Archive& archive) { archive(current_, used_, warmth_); }

 private:
  PowerParameters parameters_;
  double current_ = 0.0, used_ = 0.0, warmth_ = 0.0;
};

}  // namespace jarol::vehicles

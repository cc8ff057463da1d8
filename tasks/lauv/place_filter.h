// Where the submarine is and how the water moves, from its way through the water, GPS and ranges to beacons.
#pragma once

#include <array>
#include <cstdint>

#include "graph/values/describe.h"

namespace jarol::tasks {

/// An extended Kalman filter of s = [x y c_x c_y]: the place in NED and the current, which carries the water over
/// ground:
///   s' = [x + dt (v_x + c_x), y + dt (v_y + c_y), c_x, c_y],   P' = F P F^T + Q dt,   v: through the water, in NED.
/// A reading z = h(s) with deviation sigma: e = z - h, S = H P H^T + sigma^2, K = P H^T / S, s += K e, P -= K H P
/// (Jazwinski, "Stochastic Processes and Filtering Theory", 1970, section 8.3). One with e^2 > gate^2 S fits nothing
/// that is known, and is left out. GPS measures x and y; the range to a beacon at b is h = |p - b|, H = [(x - b_x)/h (y
/// - b_y)/h 0 0].
struct PlaceFilter {
  /// SI units; deviations.
  struct Model {
    double drift = 0, change = 0, current = 0;
    double fix = 0, range = 0;
    double gate = 0;
  };
  std::array<double, 4> s{};
  std::array<double, 16> P{};  // row by row

  static constexpr auto fields() {
    return describe(field<&PlaceFilter::s>("", "m: north, east; m/s: the current's"),
                    field<&PlaceFilter::P>("", "its covariance, row by row"));
  }

  /// There, and nothing is known of the current.
  void begin(const Model& model, double x, double y);
  /// dt at that velocity through the water.
  void predict(const Model& model, double v_x, double v_y, double dt);
  /// False: it was left out.
  bool take_fix(const Model& model, double x, double y);
  /// `below`: the beacon's depth less the vehicle's.
  bool take_range(const Model& model, double x, double y, double below, double range);

 private:
  double variance(const std::array<double, 2>& h) const;
  void correct(const std::array<double, 2>& h, double error, double sigma);
};

}  // namespace jarol::tasks

// Angles, limits and the shape of the Earth, as laws, vehicles and distributers share them.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>

namespace jarol {

inline constexpr double pi = 3.14159265358979323846;
/// In rad.
inline constexpr double degree = pi / 180.0;

/// Standard gravity to two places (m/s^2): what all laws and simulated vehicles start from.
inline constexpr double gravity = 9.81;

/// The same from -limit to limit.
inline double limited(double value, double limit) { return std::clamp(value, -limit, limit); }

/// The same angle from -pi to pi (rad).
inline double wrapped(double angle) { return std::remainder(angle, 2.0 * pi); }

inline double seconds(std::chrono::nanoseconds duration) { return 1e-9 * static_cast<double>(duration.count()); }

/// Distances on the ground per radian of latitude and longitude (m/rad), of the ellipsoid of WGS-84 (NIMA TR8350.2).
struct EarthRadii {
  double north = 0, east = 0;
};

/// At a latitude (rad): the radius of curvature in the meridian, and that of the circle of latitude.
inline EarthRadii earth_radii(double latitude) {
  constexpr double equatorial = 6378137.0, eccentricity_squared = 6.69437999014e-3;
  const double s = std::sin(latitude), w = 1.0 - eccentricity_squared * s * s;
  const double normal = equatorial / std::sqrt(w);  // radius of curvature in the prime vertical
  return {normal * (1.0 - eccentricity_squared) / w, normal * std::cos(latitude)};
}

}  // namespace jarol

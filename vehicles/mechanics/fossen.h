// A rigid body in water: M_rb nu_dot + M_a nu_dot + C_rb nu + C_a nu + D nu + g(eta) = tau, after Fossen, "Handbook of
// Marine Craft Hydrodynamics and Motion Control", 2011. All in body axes b (forward, right, down) about the origin of
// b. Plain C++17, as the unit that includes Simbody includes it.
#pragma once

#include <array>
#include <cstddef>

namespace jarol::vehicles::fossen {

using Vector3 = std::array<double, 3>;
using Vector6 = std::array<double, 6>;  // force then moment, or linear then angular velocity
using Matrix6 = std::array<Vector6, 6>;

inline Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline double dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

inline Vector6 multiply(const Matrix6& M, const Vector6& x) {
  Vector6 y{};
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) y[i] += M[i][j] * x[j];
  }
  return y;
}

/// Inverse of a symmetric positive definite matrix; throws InputError for any other.
Matrix6 inverse(const Matrix6& M);

/// M_rb of a mass with its centre r_bg below the origin and principal moments of inertia about the origin, eq. (3.44).
Matrix6 rigid_body_mass(double mass, const Vector3& r_bg, const Vector3& inertia);

/// C(nu) nu of a symmetric mass matrix, from Kirchhoff's equations, eq. (3.46): it does no work.
Vector6 coriolis(const Matrix6& M, const Vector6& nu);

/// D(nu) = linear + lift |u| + quadratic |nu|, in the published convention: force on the body, diagonal negative.
struct Damping {
  Matrix6 linear{};
  Matrix6 lift{};
  Matrix6 quadratic{};  // column j times |nu_j|
};

/// -D(nu) nu: the force on the body.
Vector6 damping_force(const Damping& D, const Vector6& nu);

}  // namespace jarol::vehicles::fossen

#include "vehicles/mechanics/fossen.h"

#include <cmath>
#include <cstddef>

#include "graph/text/errors.h"

namespace jarol::vehicles::fossen {
namespace {

Vector3 linear(const Vector6& x) { return {x[0], x[1], x[2]}; }
Vector3 angular(const Vector6& x) { return {x[3], x[4], x[5]}; }

// lower L with L L' = M
Matrix6 cholesky(const Matrix6& M) {
  Matrix6 L{};
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double rest = M[i][j];
      for (std::size_t k = 0; k < j; ++k) rest -= L[i][k] * L[j][k];
      if (i == j && !(rest > 0.0)) throw InputError("the mass matrix is not positive definite");
      L[i][j] = i == j ? std::sqrt(rest) : rest / L[j][j];
    }
  }
  return L;
}

}  // namespace

Matrix6 inverse(const Matrix6& M) {
  const Matrix6 L = cholesky(M);
  Matrix6 inverse{};
  for (std::size_t column = 0; column < 6; ++column) {
    // L y = e, then L' x = y
    Vector6 y{};
    for (std::size_t i = 0; i < 6; ++i) {
      double rest = i == column ? 1.0 : 0.0;
      for (std::size_t k = 0; k < i; ++k) rest -= L[i][k] * y[k];
      y[i] = rest / L[i][i];
    }
    for (std::size_t i = 6; i-- > 0;) {
      double rest = y[i];
      for (std::size_t k = i + 1; k < 6; ++k) rest -= L[k][i] * inverse[k][column];
      inverse[i][column] = rest / L[i][i];
    }
  }
  return inverse;
}

Matrix6 rigid_body_mass(double mass, const Vector3& r_bg, const Vector3& inertia) {
  Matrix6 M{};
  for (std::size_t i = 0; i < 3; ++i) {
    M[i][i] = mass;
    M[i + 3][i + 3] = inertia[i];
  }
  // upper right -m S(r_bg), lower left its transpose
  const Matrix6 S = {
      {{0, 0, 0, 0, -r_bg[2], r_bg[1]}, {0, 0, 0, r_bg[2], 0, -r_bg[0]}, {0, 0, 0, -r_bg[1], r_bg[0], 0}}};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 3; j < 6; ++j) M[i][j] = M[j][i] = -mass * S[i][j];
  }
  return M;
}

Vector6 coriolis(const Matrix6& M, const Vector6& nu) {
  const Vector6 momentum = multiply(M, nu);
  const Vector3 force = cross(angular(nu), linear(momentum));
  const Vector3 from_spin = cross(angular(nu), angular(momentum));
  const Vector3 from_drift = cross(linear(nu), linear(momentum));
  return {force[0],
          force[1],
          force[2],
          from_spin[0] + from_drift[0],
          from_spin[1] + from_drift[1],
          from_spin[2] + from_drift[2]};
}

Vector6 damping_force(const Damping& D, const Vector6& nu) {
  const double speed = std::abs(nu[0]);
  Vector6 force{};
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) {
      force[i] += (D.linear[i][j] + D.lift[i][j] * speed + D.quadratic[i][j] * std::abs(nu[j])) * nu[j];
    }
  }
  return force;
}

}  // namespace jarol::vehicles::fossen

#include "tasks/lauv/place_filter.h"

#include <cmath>
#include <cstddef>

namespace jarol::tasks {
namespace {

constexpr double square(double value) { return value * value; }

}  // namespace

void PlaceFilter::begin(const Model& model, double x, double y) {
  s = {x, y, 0, 0};
  P = {};
  P[0] = P[5] = square(model.fix);
  P[10] = P[15] = square(model.current);
}

void PlaceFilter::predict(const Model& model, double v_x, double v_y, double dt) {
  s[0] += dt * (v_x + s[2]);
  s[1] += dt * (v_y + s[3]);
  // F P, then times F^T: rows and columns of the place get dt times those of the current
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t i = 0; i < 2; ++i) P[4 * i + k] += dt * P[4 * (i + 2) + k];
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t i = 0; i < 2; ++i) P[4 * k + i] += dt * P[4 * k + i + 2];
  P[0] += square(model.drift) * dt;
  P[5] += square(model.drift) * dt;
  P[10] += square(model.change) * dt;
  P[15] += square(model.change) * dt;
}

double PlaceFilter::variance(const std::array<double, 2>& h) const {
  return h[0] * (h[0] * P[0] + h[1] * P[1]) + h[1] * (h[0] * P[4] + h[1] * P[5]);
}

void PlaceFilter::correct(const std::array<double, 2>& h, double error, double sigma) {
  const double S = variance(h) + square(sigma);
  std::array<double, 4> PH{};
  for (std::size_t i = 0; i < 4; ++i) PH[i] = P[4 * i] * h[0] + P[4 * i + 1] * h[1];
  for (std::size_t i = 0; i < 4; ++i) s[i] += PH[i] / S * error;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 4; ++k) P[4 * i + k] -= PH[i] * PH[k] / S;
}

bool PlaceFilter::take_fix(const Model& model, double x, double y) {
  // both or none
  const bool fits = square(x - s[0]) <= square(model.gate) * (P[0] + square(model.fix)) &&
                    square(y - s[1]) <= square(model.gate) * (P[5] + square(model.fix));
  if (!fits) return false;
  correct({1, 0}, x - s[0], model.fix);
  correct({0, 1}, y - s[1], model.fix);
  return true;
}

bool PlaceFilter::take_range(const Model& model, double x, double y, double below, double range) {
  const double north = s[0] - x, east = s[1] - y, expected = std::sqrt(north * north + east * east + below * below);
  if (expected == 0) return false;  // it points nowhere
  const std::array<double, 2> h = {north / expected, east / expected};
  const double error = range - expected;
  if (square(error) > square(model.gate) * (variance(h) + square(model.range))) return false;
  correct(h, error, model.range);
  return true;
}

}  // namespace jarol::tasks

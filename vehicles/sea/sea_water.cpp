#include "vehicles/sea/sea_water.h"

#include <cmath>

namespace jarol::vehicles {
namespace {

// of water of salinity 35 at 15 degC, S/m
constexpr double standard_conductivity = 4.2914;

double polynomial(const double (&coefficients)[6], double x) {
  double sum = 0.0;
  for (int i = 5; i >= 0; --i) sum = sum * x + coefficients[i];
  return sum;
}

}  // namespace

double calc_salinity(double conductivity, double temperature) {
  const double t = temperature;
  const double r_t = 0.6766097 + t * (2.00564e-2 + t * (1.104259e-4 + t * (-6.9698e-7 + t * 1.0031e-9)));
  const double root = std::sqrt(std::fmax(conductivity, 0.0) / standard_conductivity / r_t);
  const double at_15 = polynomial({0.0080, -0.1692, 25.3851, 14.0941, -7.0261, 2.7081}, root);
  const double by_t = polynomial({0.0005, -0.0056, -0.0066, -0.0375, 0.0636, -0.0144}, root);
  return at_15 + (t - 15.0) / (1.0 + 0.0162 * (t - 15.0)) * by_t;
}

double calc_conductivity(double temperature, double salinity) {
  double low = 0.0, high = 20.0;
  for (double middle = 10.0; low < middle && middle < high; middle = 0.5 * (low + high))
    (calc_salinity(middle, temperature) < salinity ? low : high) = middle;
  return high;
}

double calc_sound_speed(double temperature, double salinity, double depth) {
  const double t = temperature;
  return 1449.2 + t * (4.6 + t * (-0.055 + t * 0.00029)) + (1.34 - 0.010 * t) * (salinity - 35.0) + 0.016 * depth;
}

}  // namespace jarol::vehicles

// What the raw numbers of JAVIATOR_DATA stand for, in SI units; scales as the JAviator's flight controller has them.
#pragma once

#include <array>
#include <cstdint>
#include <numbers>

namespace jarol::messages::javiator {

constexpr double radians_per_count = 2 * std::numbers::pi / 65536;  // attitude
constexpr double radians_per_second_per_count = 8.5 / 32768;        // rates
constexpr double newtons_per_kilogram_per_count = 9.81 / 4681;      // specific force
constexpr double sonar_metres_per_count = 3.0 / 1024;
constexpr double pascals_per_count = 115e3 / 16777216;
constexpr double volts_per_count = 18.0 / 1024;

constexpr double celsius_of(std::uint16_t temp) { return 100.0 / 4096 * temp - 7; }

/// Of seven digits in mm and a NUL; what follows anything else does not count.
constexpr double metres_of(const std::array<std::uint8_t, 8>& digits) {
  double millimetres = 0;
  for (const std::uint8_t digit : digits) {
    if (digit < '0' || digit > '9') break;
    millimetres = 10 * millimetres + (digit - '0');
  }
  return 1e-3 * millimetres;
}

}  // namespace jarol::messages::javiator

#include "graph/analysis/load.h"

#include <numeric>

namespace jarol::analysis {

std::optional<std::strong_ordering> compare_utilisation(std::span<const Load> loads, std::int64_t bound) {
  // far from the bound rounding does not matter
  long double sum = 0;
  for (const Load& l : loads) sum += static_cast<long double>(l.wcet) / static_cast<long double>(l.period);
  const long double distance = sum - static_cast<long double>(bound);
  const long double rounding = 1e-17L * static_cast<long double>(loads.size() + 4) * (sum + 1);
  if (distance > rounding) return std::strong_ordering::greater;
  if (distance < -rounding) return std::strong_ordering::less;
  // a fraction in lowest terms, as far as 128 bits go
  Wide numerator = 0, denominator = 1;
  constexpr Wide most = static_cast<Wide>(1) << 62;
  for (const Load& l : loads) {
    const auto common = static_cast<Wide>(std::gcd(static_cast<std::int64_t>(denominator), l.period));
    const Wide scale = l.period / common;
    if (denominator > most / scale) return std::nullopt;
    numerator = numerator * scale + static_cast<Wide>(l.wcet) * (denominator / common);
    denominator *= scale;
  }
  const Wide against = denominator * bound;
  return numerator < against   ? std::strong_ordering::less
         : numerator > against ? std::strong_ordering::greater
                               : std::strong_ordering::equal;
}

double utilisation(std::span<const Load> loads) {
  double sum = 0;
  for (const Load& l : loads) sum += static_cast<double>(l.wcet) / static_cast<double>(l.period);
  return sum;
}

std::optional<std::int64_t> hyperperiod(std::span<const Load> loads, std::int64_t most) {
  std::int64_t lcm = 1;
  for (const Load& l : loads) {
    const Wide next = static_cast<Wide>(lcm) / std::gcd(lcm, l.period) * l.period;
    if (next > most) return std::nullopt;
    lcm = static_cast<std::int64_t>(next);
  }
  return lcm;
}

}  // namespace jarol::analysis

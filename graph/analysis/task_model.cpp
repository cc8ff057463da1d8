#include "graph/analysis/task_model.h"

#include <numeric>

namespace jarol::analysis {

std::optional<std::strong_ordering> compare_utilisation(std::span<const TaskModel> models, std::int64_t bound) {
  // far from the bound rounding does not matter
  long double sum = 0;
  for (const TaskModel& m : models)
    sum += static_cast<long double>(m.wcet.count()) / static_cast<long double>(m.period.count());
  const long double distance = sum - static_cast<long double>(bound);
  const long double rounding = 1e-17L * static_cast<long double>(models.size() + 4) * (sum + 1);
  if (distance > rounding) return std::strong_ordering::greater;
  if (distance < -rounding) return std::strong_ordering::less;
  // a fraction in lowest terms, as far as 128 bits go
  Wide numerator = 0, denominator = 1;
  constexpr Wide max = static_cast<Wide>(1) << 62;
  for (const TaskModel& m : models) {
    const auto common = static_cast<Wide>(std::gcd(static_cast<std::int64_t>(denominator), m.period.count()));
    const Wide scale = m.period.count() / common;
    if (denominator > max / scale) return std::nullopt;
    numerator = numerator * scale + static_cast<Wide>(m.wcet.count()) * (denominator / common);
    denominator *= scale;
  }
  const Wide against = denominator * bound;
  return numerator < against   ? std::strong_ordering::less
         : numerator > against ? std::strong_ordering::greater
                               : std::strong_ordering::equal;
}

double utilisation(std::span<const TaskModel> models) {
  double sum = 0;
  for (const TaskModel& m : models) sum += static_cast<double>(m.wcet.count()) / static_cast<double>(m.period.count());
  return sum;
}

std::optional<Duration> hyperperiod(std::span<const TaskModel> models, Duration max) {
  std::int64_t lcm = 1;
  for (const TaskModel& m : models) {
    const std::int64_t period = m.period.count();
    const Wide next = static_cast<Wide>(lcm) / std::gcd(lcm, period) * period;
    if (next > max.count()) return std::nullopt;
    lcm = static_cast<std::int64_t>(next);
  }
  return Duration(lcm);
}

}  // namespace jarol::analysis

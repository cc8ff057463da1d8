#include "tasks/lauv/depth_source.h"

#include <algorithm>

namespace jarol::tasks {
namespace {

constexpr double gravity = 9.81, water_density = 1000, air_pressure = 1013.25;  // hPa

}  // namespace

double calc_depth(double pressure) { return (pressure - air_pressure) * 100 / (water_density * gravity); }

void DepthSource::take(const Model& model, const Instruments& i, double dt) {
  const bool has_fix = i.place.count > fixes;
  fixes = i.place.count;
  const auto is_known = [&](Gauge& g, double reading, std::int64_t count) {
    g.silence = count > g.count ? 0 : g.silence + dt;
    g.count = count;
    if (has_fix) g.wrong = reading > model.fix_depth + model.fix_error;
    return count > 0 && g.silence <= model.timeout && !g.wrong;
  };
  const double by_pressure = calc_depth(i.pressure.value);
  const bool gauge_known = is_known(gauge, i.depth.value, i.depth.count),
             pressure_known = is_known(pressure, by_pressure, i.pressure.count);
  if (pressure_known && (!gauge_known || by_pressure > i.depth.value + model.error)) {
    depth = by_pressure;
  } else if (gauge_known) {
    depth = i.depth.value;
  } else if (has_fix) {
    depth = std::min(depth, model.fix_depth);
  }
}

}  // namespace jarol::tasks

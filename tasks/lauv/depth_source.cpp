#include "tasks/lauv/depth_source.h"

#include <algorithm>
#include <cmath>

#include "graph/math/geometry.h"

namespace jarol::tasks {
namespace {

constexpr double hectopascal = 100;  // Pa

}  // namespace

double calc_depth(const Water& water, double pressure) {
  return (pressure - water.air_pressure) * hectopascal / (water.density * gravity);
}

void DepthSource::take(const Model& model, const Instruments& i, double dt) {
  const bool has_fix = i.place.count > fixes;
  since_fix += dt;
  if (since_fix > model.timeout) fixes_in_row = 0;
  if (has_fix) {
    fixes = i.place.count;
    ++fixes_in_row;
    since_fix = 0;
  }
  const auto reports = [&](Gauge& g, double reading, std::int64_t count) {
    g.silence = count > g.count ? 0 : g.silence + dt;
    g.count = count;
    if (has_fix) g.contradicted = reading > model.fix_depth + model.fix_error ? g.contradicted + 1 : 0;
    return count > 0 && g.silence <= model.timeout;
  };
  const double by_gauge = i.depth.value, by_pressure = calc_depth(model.water, i.pressure.value);
  const bool gauge_reports = reports(gauge, by_gauge, i.depth.count),
             pressure_reports = reports(pressure, by_pressure, i.pressure.count);
  const bool agree = gauge_reports && pressure_reports && std::abs(by_gauge - by_pressure) <= model.error;
  const auto is_wrong = [&](const Gauge& g, const Gauge& other, bool other_reports) {
    if (g.contradicted < model.enough || (agree && other.contradicted > 0)) return false;
    return fixes_in_row >= model.enough || (other_reports && other.contradicted == 0);
  };
  const bool gauge_known = gauge_reports && !is_wrong(gauge, pressure, pressure_reports),
             pressure_known = pressure_reports && !is_wrong(pressure, gauge, gauge_reports);
  if (pressure_known && (!gauge_known || by_pressure > by_gauge + model.error)) {
    depth = by_pressure;
  } else if (gauge_known) {
    depth = by_gauge;
  } else if (fixes_in_row >= model.enough) {
    depth = std::min(depth, model.fix_depth);
  }
}

}  // namespace jarol::tasks

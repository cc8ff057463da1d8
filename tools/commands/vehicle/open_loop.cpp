#include "tools/commands/vehicle/open_loop.h"

#include <unistd.h>

#include <atomic>
#include <cmath>
#include <optional>

#include "distributers/links/table.h"
#include "graph/language/quantities.h"
#include "graph/text/escape.h"
#include "graph/values/bind.h"
#include "tools/commands/vehicle/motion_file.h"
#include "tools/report/progress.h"

namespace jarol::tools {
namespace {

using distributers::Table;

std::optional<std::size_t> find_input(const Table::Cell& title, const std::vector<Leaf>& inputs,
                                      const std::string& vehicle, Problems& problems) {
  std::vector<std::string> names;
  for (const Leaf& leaf : inputs) {
    if (leaf.path == title.text) return names.size();
    names.push_back(leaf.path);
  }
  problems.add(title.where, "column '" + title.text + "' is no input of vehicle '" + vehicle + "'" +
                                did_you_mean(title.text, names) + "; there are: " + list_of(names));
  return std::nullopt;
}

}  // namespace

std::vector<Commands> read_commands(const std::shared_ptr<const Source>& script, const vehicles::VehicleClass& vehicle,
                                    Problems& problems) {
  const Table table = distributers::read_table(script, problems);
  for (const Table::Cell& condition : table.expectations)
    problems.add(condition.where, "'expect' is for a mission of a graph, which jarol run judges; leave it out here");
  const std::vector<Leaf> inputs = leaves_of(*vehicle.inputs);
  std::vector<std::optional<std::size_t>> columns;
  for (const Table::Cell& title : table.titles) {
    columns.push_back(find_input(title, inputs, vehicle.name, problems));
    for (std::size_t i = 0; columns.back() && i + 1 < columns.size(); ++i)
      if (columns[i] == columns.back()) problems.add(title.where, "column '" + title.text + "' stands there twice");
  }
  std::vector<Commands> all;
  Value now(*vehicle.inputs);
  for (const Table::Row& row : table.rows) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const Table::Cell& cell = row.cells[i];
      if (cell.text.empty() || !columns[i]) continue;
      const Leaf& leaf = inputs[*columns[i]];
      const vehicles::Range& range = vehicle.ranges[*columns[i]];
      double value = 0;
      std::string bad = parse_scalar(*leaf.type, cell.text, leaf.unit, &value);
      if (bad.empty() && !(value >= range.min && value <= range.max))
        bad = "is not between " + number_text(range.min) + " and " + number_text(range.max) +
              (leaf.unit.empty() ? "" : " " + leaf.unit);
      if (!bad.empty()) problems.add(cell.where, "column '" + leaf.path + "': '" + cell.text + "' " + bad);
      *reinterpret_cast<double*>(static_cast<std::byte*>(now.data()) + leaf.offset) = value;
    }
    all.push_back({row.time, now});
  }
  return all;
}

void run_open_loop(vehicles::Vehicle& vehicle, const vehicles::VehicleClass& vehicle_class,
                   const std::vector<Commands>& commands, Duration period, Duration end, const std::string& path) {
  MotionFile file(path, vehicle_class, period);
  std::atomic<Duration> reached{};
  const Progress progress(::isatty(STDERR_FILENO) == 1 && end > Duration{}, end, [&] { return reached.load(); });
  std::size_t next = 0;
  for (Duration at{};; at += vehicle.grid()) {
    reached = at;
    file.add({at, false, vehicle});
    if (at >= end) break;
    while (next < commands.size() && commands[next].time <= at) ++next;
    // given again at each step, so that no time-out of the vehicle ends a row before its time
    if (next > 0) vehicle.command(commands[next - 1].inputs.data());
    vehicle.step();
  }
  file.commit();
}

}  // namespace jarol::tools

#include "tools/commands/vehicle/motion_file.h"

#include "graph/language/quantities.h"
#include "graph/text/escape.h"
#include "graph/values/type_of.h"

namespace jarol::tools {
namespace {

void add_cells(std::string& row, const std::vector<Leaf>& leaves, const void* value) {
  for (const Leaf& leaf : leaves) {
    const void* cell = static_cast<const std::byte*>(value) + leaf.offset;
    row += ',';
    if (leaf.type->finite(cell)) row += scalar_text(*leaf.type, cell);
  }
}

}  // namespace

MotionFile::MotionFile(const std::string& path, const vehicles::VehicleClass& vehicle_class,
                       std::chrono::nanoseconds period)
    : period_(period),
      states_(leaves_of(type_of<vehicles::VehicleState>())),
      outputs_(leaves_of(*vehicle_class.outputs)),
      file_(path) {
  row_ = "time";
  for (const auto* leaves : {&states_, &outputs_})
    for (const Leaf& leaf : *leaves) row_ += "," + csv_text(leaf.path);
  file_.write(row_ + "\n");
}

void MotionFile::add(const VehicleMoment& moment) {
  if (moment.instant % period_ != std::chrono::nanoseconds{}) return;
  const vehicles::VehicleState state = moment.vehicle.state();
  row_ = seconds_text(moment.instant);
  add_cells(row_, states_, &state);
  add_cells(row_, outputs_, moment.vehicle.outputs());
  file_.write(row_ + "\n");
}

}  // namespace jarol::tools

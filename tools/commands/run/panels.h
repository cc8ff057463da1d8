// Which fields a picture of a run shows.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "graph/model/graph.h"
#include "runtime/plan/output.h"
#include "tools/drawing/plot/plot_svg.h"

namespace jarol {
struct Overrides;
}

namespace jarol::tools {

struct Picture {
  std::vector<Panel> panels;
  PictureExtras extras{};
};

/// What the vehicle reports in answer to commands, beside these and what is true; what it is commanded; and its path
/// from above. Where nothing is reported so, what is published first, which is said. `truths`: by distributer the
/// type of what is known of its vehicle, or null.
Picture picture_of(const Graph& graph, const std::vector<Output>& outputs, const std::vector<const Type*>& truths);

/// Those whose names fit one of the patterns, each once. Throws InputError where a pattern fits none, or all
/// together fit more than there is room for.
std::vector<Panel> panels_named(const std::string& patterns, const std::vector<Output>& outputs);

/// "profile at_sea, seed 7, tasks.depth.parameters.kp=0.3": how the run differs from others of its graph.
std::string note_of(const Overrides& overrides, std::uint64_t seed);

}  // namespace jarol::tools

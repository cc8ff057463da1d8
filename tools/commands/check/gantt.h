// What ran when on one core, as a chart of characters.
#pragma once

#include <string>
#include <vector>

#include "graph/analysis/check.h"

namespace jarol::tools {

/// From where on all pieces are known that ran before the late activation ended: its release, or later, since only so
/// many are kept.
Duration known_from(const analysis::Result& result);

/// The window around the late activation: one line per task that ran in it, `#` while it ran, `!` past the deadline of
/// the late one, `^` at its release and `|` at its deadline, where these are known. `width` columns.
std::string gantt_text(const Graph& graph, const analysis::Result& result, std::size_t width = 72);

/// As an SVG picture: that window, or, where no activation is shown to be late, who runs when over a hyperperiod or the
/// begin of one. Empty: not every task has a 'wcet', or there is none.
std::string gantt_svg(const Graph& graph, const analysis::Result& result);

}  // namespace jarol::tools

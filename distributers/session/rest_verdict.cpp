#include "distributers/session/rest_verdict.h"

#include <algorithm>

#include "graph/language/quantities.h"
#include "graph/text/escape.h"

namespace jarol {

std::optional<Duration> longest_rest(const Graph& graph) {
  return graph.at_end ? std::optional(graph.at_end->longest) : std::nullopt;
}

Ending asked_ending(const RunEnd& end) { return end.before_rest.value_or(Ending::over()); }

bool is_cut_short(const RunEnd& end) { return end.ending.reason != asked_ending(end).reason; }

std::string not_at_rest_text(const Graph& graph, const std::optional<RestReport>& rest, const RunEnd& end) {
  if ((!rest && !end.before_rest) || (rest && rest->reached)) return "";
  if (rest && !rest->heard)
    return "whether the vehicle came to rest is not known: it was silent when " +
           (is_cut_short(end) ? end.ending.reason : duration_text(graph.at_end->longest) + " were over");
  return "the vehicle did not come to rest: '" + printable(graph.at_end->until.text) + "' was not so " +
         (is_cut_short(end) ? "when " + end.ending.reason : "within " + duration_text(graph.at_end->longest));
}

Duration judged_until(const std::optional<Duration>& rest_begun, Duration until, Duration reached) {
  return rest_begun ? std::min({*rest_begun, until, reached}) : reached;
}

}  // namespace jarol

#include "tools/report/rest_report.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "graph/language/quantities.h"
#include "graph/text/escape.h"
#include "tools/report/value_json.h"

namespace jarol::tools {
std::string command_text(const Graph& graph) {
  std::string text;
  for (const EndCommand& command : graph.at_end->commands) {
    std::string fields;
    for (const Leaf& leaf : command.stated) {
      const std::string value =
          scalar_text(*leaf.type, static_cast<const std::byte*>(command.value.data()) + leaf.offset);
      fields += (fields.empty() ? "" : ", ") + (leaf.path.empty() ? value : leaf.path + ": " + value);
    }
    text += (text.empty() ? "" : ", ") + graph.communicators[command.communicator].name + " {" + fields + "}";
  }
  return text;
}

nlohmann::ordered_json command_to_json(const Graph& graph) {
  auto command = nlohmann::ordered_json::object();
  for (const EndCommand& each : graph.at_end->commands)
    for (const Leaf& leaf : each.stated) {
      const std::string& name = graph.communicators[each.communicator].name;
      auto value = to_json(*leaf.type, static_cast<const std::byte*>(each.value.data()) + leaf.offset);
      (leaf.path.empty() ? command[name] : command[name][leaf.path]) = std::move(value);
    }
  return command;
}

std::string rest_begins_text(const Graph& graph, const Ending& why) {
  return "ending, as " + why.reason + ": " + command_text(graph) + " until " + printable(graph.at_end->until.text) +
         ", at most " + duration_text(graph.at_end->longest) + "; interrupt " +
         (why.cause == Ending::Cause::signal ? "again" : "twice") + " to hand over the safe commands at once\n";
}

std::string to_text(const Graph& graph, const std::optional<RestReport>& rest, const RunEnd& end) {
  if (!rest && !end.before_rest) return "";
  const std::string begin = "  at end      " + command_text(graph);
  if (!rest) return begin + ": NOT COMMANDED, as " + end.ending.reason + "\n";
  return begin + " from " + seconds_text(rest->begun) + " s, as " + asked_ending(end).reason + ": " +
         (rest->reached ? "at rest" : "NOT AT REST") + " after " + seconds_text(rest->ended - rest->begun) + " s" +
         (!rest->reached && is_cut_short(end) ? ", as " + end.ending.reason : "") + "\n";
}

nlohmann::ordered_json to_json(const Graph& graph, const std::optional<RestReport>& rest, const RunEnd& end) {
  if (!rest && !end.before_rest) return {};
  nlohmann::ordered_json json{{"reason", asked_ending(end).reason},
                              {"command", command_to_json(graph)},
                              {"until", graph.at_end->until.text},
                              {"longest_ns", graph.at_end->longest.count()},
                              {"reached", rest && rest->reached}};
  if (rest) {
    json["begun_ns"] = rest->begun.count();
    json["took_ns"] = (rest->ended - rest->begun).count();
    json["heard"] = rest->heard;
  }
  if ((!rest || !rest->reached) && is_cut_short(end)) json["cut_short_by"] = end.ending.reason;
  return json;
}

}  // namespace jarol::tools

#include "graph/model/channels.h"

#include <algorithm>
#include <map>

namespace jarol {

void resolve_channel(const CommunicatorSpec& spec, const std::string& subject, const Graph& graph,
                     Communicator& communicator, Problems& problems) {
  for (const bool given : {spec.type.has_value(), spec.direction.has_value()})
    if (given) {
      problems.add(spec.where,
                   subject + " has a channel and so its type and direction; leave 'type' and 'direction' out");
      break;
    }
  const std::string& text = spec.channel->value;
  const std::size_t dot = text.find('.');
  const std::string name = text.substr(0, dot);
  const auto found = std::find_if(graph.distributers.begin(), graph.distributers.end(),
                                  [&](const Distributer& d) { return d.name == name; });
  if (dot == std::string::npos || found == graph.distributers.end()) {
    const auto names = names_of(graph.distributers);
    problems.add(spec.channel->where, subject + " has channel '" + text + "', but there is no distributer '" + name +
                                          "'" + did_you_mean(name, names) +
                                          "; write distributer.channel, with one of: " + list_of(names));
    return;
  }
  if (found->distributer_class == nullptr) return;  // reported there
  const auto& channels = found->distributer_class->channels;
  const std::string wanted = text.substr(dot + 1);
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (channels[i].name != wanted) continue;
    communicator.distributer = static_cast<std::size_t>(found - graph.distributers.begin());
    communicator.channel = i;
    communicator.type = channels[i].type;
    communicator.direction = channels[i].direction;
    return;
  }
  problems.add(spec.channel->where, "distributer '" + name + "' (" + found->distributer_class->name +
                                        ") has no channel '" + wanted + "'" + did_you_mean(wanted, names_of(channels)) +
                                        "; it has: " + list_of(names_of(channels)));
}

void check_channels(const Graph& graph, Problems& problems) {
  std::map<std::pair<std::size_t, std::size_t>, const Communicator*> users;
  for (const Communicator& c : graph.communicators) {
    if (!c.distributer) continue;
    const auto [at, first] = users.emplace(std::pair(*c.distributer, c.channel), &c);
    if (first) continue;
    const std::string other = "the same channel as '" + at->second->name + "'; ";
    problems.add(c.where,
                 "communicator '" + c.name + "' " +
                     (c.direction == Direction::out ? "hands over to " + other + "a channel has one writer"
                                                    : "takes from " + other + "connect that one to all who read it"),
                 {{at->second->where, "the other one"}});
  }
}

}  // namespace jarol

// Link types that a plugin brings: JAROL_PLUGIN(..., Radio) where Radio is a class with a static link_type(), which
// packet_link (packet_link.h) makes of a Transport (transport.h), or link_type (link_type.h) of external systems of
// another sort. The guardian holds the way to a peer that the transport has shown to its `holder`, and no other.
#pragma once

#include <concepts>
#include <memory>
#include <string>
#include <utility>

#include "distributers/links/packet_link.h"
#include "graph/plugins/plugin.h"

namespace jarol {

namespace distributers {
/// As an extension of a plugin, whose `what` is a LinkType.
inline constexpr char link_extension_kind[] = "link type";
}  // namespace distributers

template <class L>
requires requires {
  { L::link_type() } -> std::same_as<distributers::LinkType>;
}
struct PluginPart<L> {
  static void add(PluginParts& parts) {
    distributers::LinkType made = L::link_type();
    std::string name = made.name;
    parts.extensions.push_back({distributers::link_extension_kind, std::move(name),
                                std::make_shared<const distributers::LinkType>(std::move(made))});
  }
};

}  // namespace jarol

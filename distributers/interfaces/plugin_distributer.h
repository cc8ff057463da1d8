// Distributers that a plugin brings: JAROL_PLUGIN(..., RoverRadio) where that is a class as distributer.h says.
#pragma once

#include "distributers/interfaces/typed.h"
#include "graph/plugins/plugin.h"

namespace jarol {

template <class D>
requires requires { D::handlers(); }
struct PluginPart<D> {
  static_assert(has_own_name<D>(), "a distributer has a name of its own: struct Near : Radio<1> {}; for Radio<1>");
  static void add(PluginParts& parts) { parts.graph.add(distributers::distributer_class<D>()); }
};

}  // namespace jarol

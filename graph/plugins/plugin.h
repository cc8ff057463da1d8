// What a shared library with tasks of its own includes; its whole interface to Jarol (with distributers, vehicles, link
// types, policies and grammars: distributers/interfaces/plugin_distributer.h, plugin_vehicle.h,
// distributers/links/plugin_link.h, graph/plugins/plugin_policy.h, plugin_grammar.h):
//
//   #include "graph/plugins/plugin.h"
//   struct Twice { static constexpr std::string_view summary = "doubles"; struct In { ... }; ... };
//   JAROL_PLUGIN(Twice)
//
// Built with the compiler that built jarol: c++ -std=c++20 -O2 -ffp-contract=off -fno-gnu-unique -fPIC -shared
// -I <jarol's sources> $(pkg-config --cflags eigen3) twice.cpp -o twice.so; named in a graph as `plugins: [twice.so]`.
// g++ needs -fno-gnu-unique, else two plugins share what they call by one name; clang has and needs no such option.
#pragma once

// before the headers that such structs do not fit
struct JarolUnpacked {
  char first;
  double second;
};
static_assert(sizeof(JarolUnpacked) == 2 * sizeof(double), "a plugin can't be built with -fpack-struct");

// first, so that the compiler's lines around an error in a description or in a task's form are few
#include "graph/values/describe.h"

#include "graph/task.h"

#include "graph/plugins/parts.h"
#include "graph/plugins/plugin_build.h"

namespace jarol {

/// Does a type's name belong to it? Of a template it is that of an argument.
template <class T>
constexpr bool has_own_name() {
  return detail::is_name_character(detail::argument_of(detail::pretty_type<T>()).back());
}

/// How what a plugin names is added: a task. The headers of distributers, vehicles, link types, policies and grammars
/// say how those are.
template <class T>
struct PluginPart {
  static_assert(has_own_name<T>(),
                "a task has a name of its own: struct Fast : Smooth<float> {}; and JAROL_PLUGIN(Fast)");
  static void add(PluginParts& parts) { parts.graph.add(task_class<T>()); }
};

template <class... T>
void add_parts_of_plugin(PluginParts& parts) {
  (PluginPart<T>::add(parts), ...);
}

}  // namespace jarol

/// Visible also in a library that is built with -fvisibility=hidden.
#define JAROL_VISIBLE extern "C" [[gnu::used, gnu::visibility("default")]]

/// Names what the library brings, tasks, distributers, vehicles, link types, policies and grammars.
#define JAROL_PLUGIN(...)                                                                                    \
  JAROL_VISIBLE const jarol::PluginBuild jarol_plugin_build = jarol::build_of_this_file();                   \
  JAROL_VISIBLE bool jarol_plugin_rounds_products(const volatile double& x, const volatile double& square) { \
    return jarol::rounds_products(x, square);                                                                \
  }                                                                                                          \
  JAROL_VISIBLE void jarol_plugin_add(jarol::PluginParts& parts) { jarol::add_parts_of_plugin<__VA_ARGS__>(parts); }

// What a shared library with tasks of its own includes; its whole interface to Jarol:
//
//   #include "graph/plugin.h"
//   struct Twice { static constexpr std::string_view summary = "doubles"; struct In { ... }; ... };
//   JAROL_PLUGIN(Twice)
//
// Built with the compiler that built jarol: c++ -std=c++20 -O2 -ffp-contract=off -fPIC -shared -I <jarol's sources>
// $(pkg-config --cflags eigen3) twice.cpp -o twice.so; named in a graph as `plugins: [twice.so]`.
#pragma once

#include "graph/registry.h"

namespace jarol {

/// Changes with every change of the binary interface; the compiler is part of it.
inline constexpr const char* plugin_form = "form 3 of " __VERSION__;

template <class... T>
void add_tasks_of_plugin(Registry& registry) {
  (registry.add(task_class<T>()), ...);
}

}  // namespace jarol

/// Names the tasks that the library brings, once in a library.
#define JAROL_PLUGIN(...)                                                   \
  extern "C" const char* jarol_plugin_form() { return jarol::plugin_form; } \
  extern "C" void jarol_plugin_add(jarol::Registry& registry) { jarol::add_tasks_of_plugin<__VA_ARGS__>(registry); }

// Timing grammars that a plugin brings: JAROL_PLUGIN(..., Rates) where
//
//   struct Rates {
//     static constexpr std::string_view name = "rates", how = "tasks state how often they run in the graph's period";
//     static constexpr jarol::GrammarKey keys[] = {{"tasks", "frequency", "activations in the graph's period"}};
//     static void lower(jarol::Yaml& graph, jarol::Problems& problems);
//   };
//
// A graph that states `timing: {grammar: rates}` is rewritten by lower() before anything else looks at it, so that all
// know the words of the language alone. graph/README.md has one.
#pragma once

#include <concepts>
#include <iterator>

#include "graph/language/grammar.h"
#include "graph/plugins/plugin.h"

namespace jarol {

/// A struct with a static lower() of this form is a grammar.
template <class G>
concept GrammarForm = requires {
  requires std::convertible_to<decltype(&G::lower), decltype(Grammar::lower)>;
};

template <GrammarForm G>
struct PluginPart<G> {
  static void add(PluginParts& parts) {
    parts.graph.add(Grammar{G::name, G::how, {std::begin(G::keys), std::end(G::keys)}, G::lower});
  }
};

}  // namespace jarol

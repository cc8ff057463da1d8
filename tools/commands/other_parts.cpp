#include "tools/commands/other_parts.h"

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "graph/policy.h"

namespace jarol::tools {
namespace {
using distributers::LinkType;
using Json = nlohmann::ordered_json;

std::string who_joins(const LinkType& link) {
  return link.for_vehicles ? "of vehicles" : link.for_operators ? "of operators" : "of vehicles and operators";
}

Json vehicle_json(const vehicles::VehicleClass& vehicle) {
  return {{"name", vehicle.name}, {"summary", vehicle.summary}};
}

Json link_json(const LinkType& link) {
  auto keys = Json::array();
  for (const KeyDescription& key : link.keys)
    keys.push_back({{"name", key.name}, {"required", key.required}, {"text", key.text}});
  return {{"name", link.name},
          {"summary", link.summary},
          {"vehicles", !link.for_operators},
          {"operators", !link.for_vehicles},
          {"needs_one_of", link.needs_one_of},
          {"keys", std::move(keys)}};
}

Json policy_json(const Policy& policy) {
  return {{"name", policy.name},
          {"how", policy.how},
          {"interrupts", policy.interrupts},
          {"keeps_core", policy.keeps_core},
          {"executed_on_real_clock", policy.executed}};
}

Json grammar_json(const Grammar& grammar) {
  auto keys = Json::array();
  for (const GrammarKey& key : grammar.keys)
    keys.push_back({{"section", key.section}, {"name", key.name}, {"text", key.text}});
  return {{"name", grammar.name}, {"how", grammar.how}, {"keys", std::move(keys)}};
}

void print_link(const LinkType& link) {
  std::cout << "link " << link.name << ": " << link.summary << ", " << who_joins(link) << "\n\nkeys\n";
  std::size_t width = 0;
  for (const KeyDescription& key : link.keys) width = std::max(width, key.name.size());
  for (const KeyDescription& key : link.keys) {
    if (key.name == "type") continue;  // its own name
    std::cout << "  " << key.name << std::string(width - key.name.size() + 2, ' ') << key.text
              << (key.required ? "; required" : "") << "\n";
  }
}

void print_policy(const Policy& policy) {
  std::cout << "policy " << policy.name << ": " << policy.how << "\n\n"
            << "  a task that runs " << (policy.interrupts ? "is interrupted by" : "ends before")
            << " a more urgent one\n"
            << "  a task " << (policy.keeps_core ? "keeps its core" : "may change its core") << "\n"
            << "  jarol run " << (policy.executed ? "executes it" : "does not execute it") << " on the real clock\n";
}

void print_grammar(const Grammar& grammar) {
  std::cout << "grammar " << grammar.name << ": " << grammar.how << "\n\n";
  if (grammar.lower == nullptr) std::cout << "  the keys of specs/graphs.md, and no others\n";
  for (const GrammarKey& key : grammar.keys)
    std::cout << "  " << key.name << " of '" << key.section << "': " << key.text << "\n";
}

}  // namespace

std::vector<ListedParts> other_parts(const distributers::Registries& known) {
  std::vector<ListedParts> all{{"vehicles", {}}, {"links", {}}, {"policies", {}}, {"grammars", {}}};
  for (const auto& vehicle : known.vehicles.entries()) all[0].parts.emplace_back(vehicle.name, vehicle.summary);
  for (const LinkType& link : known.links.entries())
    all[1].parts.emplace_back(link.name, link.summary + ", " + who_joins(link));
  for (const Policy& policy : known.graph.policies()) all[2].parts.emplace_back(policy.name, policy.how);
  for (const Grammar& grammar : known.graph.grammars()) all[3].parts.emplace_back(grammar.name, grammar.how);
  return all;
}

void add_other_parts(const distributers::Registries& known, Json& to) {
  for (const char* title : {"vehicles", "links", "policies", "grammars"}) to[title] = Json::array();
  for (const auto& vehicle : known.vehicles.entries()) to["vehicles"].push_back(vehicle_json(vehicle));
  for (const LinkType& link : known.links.entries()) to["links"].push_back(link_json(link));
  for (const Policy& policy : known.graph.policies()) to["policies"].push_back(policy_json(policy));
  for (const Grammar& grammar : known.graph.grammars()) to["grammars"].push_back(grammar_json(grammar));
}

bool print_other_part(const distributers::Registries& known, const std::string& name) {
  if (const auto* vehicle = known.vehicles.find(name))
    std::cout << "vehicle " << vehicle->name << ": " << vehicle->summary << "\n\njarol vehicle " << vehicle->name
              << " --describe has its state, inputs and parameters\n";
  else if (const LinkType* link = known.links.find(name))
    print_link(*link);
  else if (const Policy* policy = known.graph.find_policy(name))
    print_policy(*policy);
  else if (const Grammar* grammar = known.graph.find_grammar(name))
    print_grammar(*grammar);
  else
    return false;
  return true;
}

bool add_other_part(const distributers::Registries& known, const std::string& name, Json& to) {
  if (const auto* vehicle = known.vehicles.find(name))
    to["vehicles"] = Json::array({vehicle_json(*vehicle)});
  else if (const LinkType* link = known.links.find(name))
    to["links"] = Json::array({link_json(*link)});
  else if (const Policy* policy = known.graph.find_policy(name))
    to["policies"] = Json::array({policy_json(*policy)});
  else if (const Grammar* grammar = known.graph.find_grammar(name))
    to["grammars"] = Json::array({grammar_json(*grammar)});
  else
    return false;
  return true;
}

}  // namespace jarol::tools

#include "tools/report/describe_vehicle.h"

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "graph/language/quantities.h"
#include "graph/values/bind.h"
#include "graph/values/type_of.h"
#include "tools/report/json_line.h"

namespace jarol::tools {
namespace {

struct Entry {
  std::string name, unit, text, value;  // value: default or range
};

const TypeField* field_at(const Type& type, const std::string& path) {
  const std::size_t dot = path.find('.');
  const TypeField* field = find_field(type, path.substr(0, dot));
  return field == nullptr || dot == std::string::npos ? field : field_at(*field->type, path.substr(dot + 1));
}

std::string value_text(const Leaf& leaf, const void* value) {
  return leaf.type->kind == Kind::duration ? duration_text(Duration(read_integer(*leaf.type, value)))
                                           : scalar_text(*leaf.type, value);
}

std::vector<Entry> entries_of(const Type& type, const void* values) {
  std::vector<Entry> entries;
  for (const Leaf& leaf : leaves_of(type)) {
    const TypeField* field = field_at(type, leaf.path);
    entries.push_back({leaf.path, leaf.unit, field == nullptr ? "" : field->text,
                       values == nullptr ? "" : value_text(leaf, static_cast<const std::byte*>(values) + leaf.offset)});
  }
  return entries;
}

struct Section {
  std::string title, value_title;
  std::vector<Entry> entries;
};

std::vector<Section> sections_of(const vehicles::VehicleClass& vehicle, const Value& parameters) {
  std::vector<Section> sections{{"state", "", entries_of(type_of<vehicles::VehicleState>(), nullptr)},
                                {"inputs", "range", entries_of(*vehicle.inputs, nullptr)}};
  for (std::size_t i = 0; i < vehicle.ranges.size(); ++i)
    sections[1].entries[i].value = number_text(vehicle.ranges[i].min) + " to " + number_text(vehicle.ranges[i].max);
  // a group of outputs each: actuators, sensors
  for (const TypeField& group : vehicle.outputs->fields) {
    sections.push_back({group.name, "", {}});
    for (Entry& entry : entries_of(*group.type, nullptr)) {
      entry.name = group.name + "." + entry.name;
      sections.back().entries.push_back(std::move(entry));
    }
  }
  sections.push_back({"true values", "", entries_of(*vehicle.truth, nullptr)});
  sections.push_back({"parameters", "value", entries_of(*vehicle.parameters, parameters.data())});
  return sections;
}

void print_text(const vehicles::VehicleClass& vehicle, const std::vector<Section>& sections) {
  std::cout << vehicle.name << ": " << vehicle.summary << "\n";
  for (const Section& section : sections) {
    std::cout << "\n" << section.title << "\n";
    std::size_t name = 0, value = 0;
    const auto with_unit = [](const Entry& e) { return e.value + (e.unit.empty() ? "" : " [" + e.unit + "]"); };
    for (const Entry& e : section.entries) {
      name = std::max(name, e.name.size());
      value = std::max(value, with_unit(e).size());
    }
    for (const Entry& e : section.entries) {
      std::string line = "  " + e.name + std::string(name - e.name.size() + 2, ' ') + with_unit(e) +
                         std::string(value - with_unit(e).size() + 2, ' ') + e.text;
      line.erase(line.find_last_not_of(' ') + 1);
      std::cout << line << "\n";
    }
  }
}

void print_json(const vehicles::VehicleClass& vehicle, const std::vector<Section>& sections) {
  nlohmann::ordered_json whole{{"schema", "jarol.vehicle/1"}, {"name", vehicle.name}, {"summary", vehicle.summary}};
  for (const Section& section : sections) {
    auto list = nlohmann::ordered_json::array();
    for (const Entry& e : section.entries) {
      nlohmann::ordered_json entry{{"name", e.name}, {"unit", e.unit}, {"text", e.text}};
      if (!section.value_title.empty()) entry[section.value_title] = e.value;
      list.push_back(std::move(entry));
    }
    whole[section.title == "true values" ? "true_values" : section.title] = std::move(list);
  }
  std::cout << json_line(whole);
}

}  // namespace

void describe_vehicle(const vehicles::VehicleClass& vehicle, const Value& parameters, bool json) {
  const std::vector<Section> sections = sections_of(vehicle, parameters);
  json ? print_json(vehicle, sections) : print_text(vehicle, sections);
}

}  // namespace jarol::tools

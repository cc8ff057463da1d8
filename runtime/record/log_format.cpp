#include "runtime/record/log_format.h"

#include <fmt/format.h>
#include <bit>
#include <nlohmann/json.hpp>

namespace jarol {
namespace {

static_assert(std::endian::native == std::endian::little);

std::string layout_of(const Type& type) {
  std::string text = fmt::format("{} {} {} {}(", type.name, static_cast<int>(type.kind), type.size, type.count);
  for (const TypeField& f : type.fields) text += fmt::format("{}@{} {};", f.name, f.offset, layout_of(*f.type));
  if (type.element != nullptr) text += layout_of(*type.element);
  return text + ")";
}

}  // namespace

std::string signature_of(const Type& type) {
  return fmt::format("{} {:016x}", type.name, digest::name_hash(layout_of(type)));
}

std::string sum_of_text(std::string_view text) { return fmt::format("{:016x}", digest::name_hash(text)); }

bool names_plugins(const std::string& set) {
  const std::string_view path = std::string_view(set).substr(0, set.find('='));
  return path == "plugins" || path.starts_with("plugins.");
}

std::string to_line(const LogHeader& header) {
  nlohmann::ordered_json json{{"schema", LogHeader::schema},
                              {"graph", header.graph},
                              {"file", header.file},
                              {"file_sum", header.file_sum},
                              {"profile", header.overrides.profile},
                              {"set", header.overrides.set},
                              {"clock", header.clock},
                              {"until_ns", header.until.count()},
                              {"mission_ns", header.mission.count()},
                              {"inputs", nlohmann::ordered_json::array()},
                              {"tasks", header.tasks}};
  for (const LogHeader::Input& input : header.inputs)
    json["inputs"].push_back({{"name", input.name}, {"type", input.signature}});
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

LogHeader parse_header(const std::string& line) {
  try {
    std::size_t values = 0;
    const auto bound = [&](int depth, nlohmann::json::parse_event_t, const nlohmann::json&) {
      if (depth > 4 || ++values > 2'000'000) throw LogError("is no log");
      return true;
    };
    const auto json = nlohmann::json::parse(line, bound);
    if (json.at("schema") != LogHeader::schema) throw LogError("is no log");
    LogHeader header{.graph = json.at("graph"),
                     .file = json.at("file"),
                     .file_sum = json.at("file_sum"),
                     .overrides = {json.at("profile"), json.at("set")},
                     .clock = json.at("clock"),
                     .until = Duration(json.value("until_ns", std::int64_t{0})),
                     .mission = Duration(json.value("mission_ns", std::int64_t{0})),
                     .tasks = json.at("tasks")};
    for (const auto& input : json.at("inputs")) header.inputs.push_back({input.at("name"), input.at("type")});
    return header;
  } catch (const nlohmann::json::exception&) { throw LogError("is no log"); }
}

}  // namespace jarol

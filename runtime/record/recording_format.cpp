#include "runtime/record/recording_format.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "graph/values/digest.h"

namespace jarol {
namespace {

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

bool names_plugins(const std::string& set) {
  const std::string_view path = std::string_view(set).substr(0, set.find('='));
  return path == "plugins" || path.starts_with("plugins.");
}

std::string to_json(const RecordingHeader& header) {
  nlohmann::ordered_json json{{"schema", RecordingHeader::schema},
                              {"graph", header.graph},
                              {"file", header.file},
                              {"profile", header.overrides.profile},
                              {"set", header.overrides.set},
                              {"clock", header.clock},
                              {"begin_ns", header.begin.count()},
                              {"until_ns", header.until.count()},
                              {"mission_ns", header.mission.count()},
                              {"seed", header.seed},
                              {"what", header.what},
                              {"version", header.version},
                              {"platform", header.platform},
                              {"inputs", nlohmann::ordered_json::array()},
                              {"truths", nlohmann::ordered_json::array()},
                              {"tasks", header.tasks}};
  for (const RecordingHeader::Input& input : header.inputs)
    json["inputs"].push_back({{"name", input.name}, {"type", input.signature}});
  for (const RecordingHeader::Truth& truth : header.truths)
    json["truths"].push_back({{"distributer", truth.distributer}, {"type", truth.signature}});
  if (!header.execution.empty()) json["execution"] = header.execution;
  if (header.split > 0) json["split_bytes"] = header.split;
  if (header.part > 1) {
    json["part"] = header.part;
    json["follows"] = header.follows;
  }
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

RecordingHeader parse_header(const std::string& text) {
  try {
    std::size_t values = 0;
    const auto bound = [&](int depth, nlohmann::json::parse_event_t, const nlohmann::json&) {
      if (depth > 4 || ++values > 2'000'000) throw LogError("is no recording");
      return true;
    };
    const auto json = nlohmann::json::parse(text, bound);
    if (json.at("schema") != RecordingHeader::schema) throw LogError("is no recording");
    RecordingHeader header{.graph = json.at("graph"),
                           .file = json.at("file"),
                           .overrides = {json.at("profile"), json.at("set")},
                           .clock = json.at("clock"),
                           .begin = Duration(json.value("begin_ns", std::int64_t{0})),
                           .until = Duration(json.at("until_ns").get<std::int64_t>()),
                           .mission = Duration(json.at("mission_ns").get<std::int64_t>()),
                           .seed = json.at("seed"),
                           .execution = json.value("execution", ""),
                           .what = json.at("what"),
                           .version = json.at("version"),
                           .platform = json.at("platform"),
                           .tasks = json.at("tasks"),
                           .split = json.value("split_bytes", std::uint64_t{0}),
                           .part = json.value("part", std::size_t{1}),
                           .follows = json.value("follows", "")};
    if (header.begin < Duration{} || header.until < Duration{} || header.mission < Duration{})
      throw LogError("is no recording");
    for (const auto& input : json.at("inputs")) header.inputs.push_back({input.at("name"), input.at("type")});
    for (const auto& truth : json.value("truths", nlohmann::json::array()))
      header.truths.push_back({truth.at("distributer"), truth.at("type")});
    return header;
  } catch (const nlohmann::json::exception&) { throw LogError("is no recording"); }
}

}  // namespace jarol

// What the results of a campaign depend on.
#include <fmt/format.h>

#include <filesystem>

#include "distributers/campaign/statement.h"
#include "graph/language/inputs.h"
#include "graph/values/digest.h"
#include "runtime/checkpoint/run_origin.h"

namespace jarol::campaign {
namespace {

std::string lines_of(const std::vector<std::string>& all) {
  std::string text;
  for (const std::string& each : all) text += (text.empty() ? "" : "\n") + each;
  return text;
}

std::string sum_of(const std::string& text) { return fmt::format("{:016x}", digest::name_hash(text)); }

}  // namespace

Identity identity_of(const GraphSource& of, const Graphs& graphs, const Campaign& campaign, std::uint64_t seed,
                     const Identity& program, const SourceSet::Sources& files) {
  std::vector<std::string> vary, metrics;
  for (const Variation& v : campaign.vary) vary.push_back(v.path + "=" + v.text);
  const Measures& measures = graphs.base().measures;
  for (std::size_t i = 0; i < measures.metrics.size(); ++i)
    metrics.push_back(measures.metrics[i].name + "=" + measures.conditions[i].text);
  Identity identity = program;
  for (const auto& [key, value] : Identity{{"graph", of.source->text},
                                           {"profile", of.overrides.profile},
                                           {"set", lines_of(of.overrides.set)},
                                           {"vary", lines_of(vary)},
                                           {"metrics", lines_of(metrics)},
                                           {"runs", campaign.runs ? std::to_string(*campaign.runs) : ""},
                                           {"sampling", campaign.sampling == Sampling::latin ? "latin" : "random"},
                                           {"for", campaign.length ? seconds_text(*campaign.length) + "s" : ""},
                                           {"seed", std::to_string(seed)}})
    identity.emplace_back(key, value);
  // vehicles, missions, plugins: wherever the campaign is resumed from
  const std::filesystem::path folder = std::filesystem::absolute(of.source->name).parent_path();
  std::error_code none;
  const std::filesystem::path itself = std::filesystem::read_symlink("/proc/self/exe", none);
  const auto add = [&](const std::string& file, const std::string& text) {
    identity.emplace_back("file " + std::filesystem::absolute(file).lexically_relative(folder).string(), sum_of(text));
  };
  for (const auto& [path, source] : files)
    if (path != "-") add(path, source->text);
  for (const std::string& file : inputs_read())
    if (file != itself && !files.contains(SourceSet::full_path(file))) add(file, read_source(file)->text);
  return identity;
}

Identity identity_of_program(const std::string& version) {
  Identity identity{{"program", version}};
  for (const auto& [name, build] : find_program())
    identity.emplace_back(identity.size() == 1 ? "build" : "library " + name, build);
  return identity;
}

}  // namespace jarol::campaign

// What the results of a campaign hang on.
#include <fmt/format.h>

#include <filesystem>

#include "distributers/campaign/statement.h"
#include "graph/language/inputs.h"
#include "graph/values/digest.h"

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
                     const std::string& program) {
  std::vector<std::string> vary, metrics;
  for (const Variation& v : campaign.vary) vary.push_back(v.path + "=" + v.text);
  const Measures& measures = graphs.base().measures;
  for (std::size_t i = 0; i < measures.metrics.size(); ++i)
    metrics.push_back(measures.metrics[i].name + "=" + measures.conditions[i].text);
  Identity identity{{"program", program},
                    {"graph", of.source->text},
                    {"profile", of.overrides.profile},
                    {"set", lines_of(of.overrides.set)},
                    {"vary", lines_of(vary)},
                    {"metrics", lines_of(metrics)},
                    {"runs", campaign.runs ? std::to_string(*campaign.runs) : ""},
                    {"sampling", campaign.sampling == Sampling::latin ? "latin" : "random"},
                    {"for", campaign.length ? seconds_text(*campaign.length) + "s" : ""},
                    {"seed", std::to_string(seed)}};
  // vehicles, missions, plugins: wherever the campaign is resumed from
  const std::filesystem::path folder = std::filesystem::absolute(of.source->name).parent_path();
  std::error_code none;
  const std::filesystem::path itself = std::filesystem::read_symlink("/proc/self/exe", none);
  for (const std::string& file : inputs_read()) {
    if (file == itself) continue;  // `program` says which it is
    identity.emplace_back("file " + std::filesystem::absolute(file).lexically_relative(folder).string(),
                          sum_of(read_source(file)->text));
  }
  return identity;
}

}  // namespace jarol::campaign

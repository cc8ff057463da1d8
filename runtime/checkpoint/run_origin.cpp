#include "runtime/checkpoint/run_origin.h"

#include <algorithm>

#include "graph/values/digest.h"
#include "runtime/record/recording_format.h"

namespace jarol {
namespace {

// Those that are to be the same. Plugins come first: a checkpoint names no code, so they are always given anew.
std::vector<std::string> fixed_part(std::vector<std::string> set) {
  std::erase_if(set, sets_parameters);
  std::stable_partition(set.begin(), set.end(), names_plugins);
  return set;
}

std::string difference_of_programs(const RunOrigin& saved, const RunOrigin& here) {
  if (saved.program.empty() || saved.program.front().second != here.program.front().second)
    return "was saved by another build of this program";
  // the program itself comes first
  for (auto part = saved.program.begin() + 1; part != saved.program.end(); ++part) {
    const auto found = std::find_if(here.program.begin() + 1, here.program.end(),
                                    [&](const auto& other) { return other.first == part->first; });
    if (found == here.program.end()) return "was saved with '" + part->first + "', which is not loaded here";
    if (found->second != part->second) return "was saved with another build of '" + part->first + "'";
  }
  return "";
}

}  // namespace

RunOrigin::File file_of(const Source& source) { return {source.name, digest::name_hash(source.text)}; }

bool sets_parameters(const std::string& set) {
  const std::string path = set.substr(0, set.find('='));
  if (!path.starts_with("tasks.")) return false;
  const std::size_t name = std::string_view("tasks.").size(), end = path.find('.', name);
  if (end == std::string::npos || end == name) return false;
  const std::string rest = path.substr(end + 1);
  return rest == "parameters" || rest.starts_with("parameters.");
}

std::string find_difference(const RunOrigin& saved, const RunOrigin& here) {
  if (std::string wrong = difference_of_programs(saved, here); !wrong.empty()) return wrong;
  if (saved.files.empty() || saved.files.front().sum != here.files.front().sum)
    return "is of another graph: the text of '" + here.files.front().name + "' is not the one that was run";
  if (saved.profile != here.profile)
    return "is of " + (saved.profile.empty() ? std::string("no profile") : "profile '" + saved.profile + "'");
  const std::vector<std::string> then = fixed_part(saved.set), now = fixed_part(here.set);
  for (const std::string& each : now)
    if (std::find(then.begin(), then.end(), each) == then.end())
      return "is of a run without '" + each + "'; parameters of tasks may change here, and nothing else";
  for (const std::string& each : then)
    if (std::find(now.begin(), now.end(), each) == now.end()) return "is of a run with '" + each + "'; give it again";
  if (then != now) return "is of a run that set the same in another order";
  if (saved.seed != here.seed) return "is of seed " + std::to_string(saved.seed);
  if (saved.fed != here.fed) return "is of a run that was fed otherwise";
  for (std::size_t i = 1; i < here.files.size(); ++i)
    if (i >= saved.files.size() || saved.files[i].sum != here.files[i].sum)
      return "is of another graph: '" + here.files[i].name + "' is not what it was";
  return saved.files.size() == here.files.size() ? "" : "is of another graph: it had more files";
}

}  // namespace jarol

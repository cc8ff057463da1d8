#include "tools/commands/run/checkpoints.h"

#include <algorithm>

#include "graph/text/errors.h"
#include "runtime/record/recording_format.h"
#include "tools/report/command_line.h"
#include "tools/report/duration_option.h"

namespace jarol::tools {

void add_checkpoint_options(Command& command, CheckpointArguments& arguments) {
  command
      .add_option("--save", arguments.saves,
                  "Save the run when it has reached an instant, as in 30s=FILE; may be given more than once")
      ->one_value();
  command
      .add_option("--resume", arguments.resume,
                  "Go on from what was saved of this graph, with its profile, --set and seed; --set may change "
                  "parameters of tasks from there on")
      ->file();
}

void require_checkpoint_effect(const Command& command, const CheckpointArguments& arguments, bool virtual_clock) {
  if (!virtual_clock)
    command.refuse({"--save", "--resume", "--what-if", "--record-checkpoints"}, "belongs to the virtual clock");
  if (arguments.resume.empty()) return;
  command.refuse({"--profile", "--seed"}, "is that of the run that was saved; leave it out");
}

std::vector<Save> parse_saves(const std::vector<std::string>& words) {
  std::vector<Save> saves;
  for (const std::string& word : words) {
    Save save;
    const std::size_t end = word.find('=');
    if (end == std::string::npos || end + 1 == word.size())
      throw InputError("--save: '" + word + "' names no file; write it as in 30s=FILE");
    save.at = duration_of("--save", word.substr(0, end));
    save.file = word.substr(end + 1);
    if (save.file == "-") throw InputError("--save: '-' is no file; --resume reads one by its name");
    saves.push_back(std::move(save));
  }
  return saves;
}

Checkpoint read_checkpoint(const std::string& file, Overrides& overrides, std::uint64_t& seed) {
  Checkpoint read = Checkpoint::read(file);
  const RunOrigin& origin = read.origin();
  overrides.profile = origin.profile;
  std::vector<std::string> set = origin.set;
  std::erase_if(set, names_plugins);
  // what is given again as it was is not given twice
  std::erase_if(overrides.set, [&](const std::string& given) {
    const std::string path = given.substr(0, given.find('=') + 1);
    const auto last = std::find_if(set.rbegin(), set.rend(), [&](const std::string& s) { return s.starts_with(path); });
    return last != set.rend() && *last == given;
  });
  overrides.set.insert(overrides.set.begin(), set.begin(), set.end());
  seed = origin.seed;
  return read;
}

}  // namespace jarol::tools

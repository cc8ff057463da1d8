// The options of runs that are saved, and that go on from what was saved.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "graph/language/load.h"
#include "runtime/checkpoint/checkpoint.h"

namespace jarol::tools {

class Command;

struct CheckpointArguments {
  std::vector<std::string> saves;  // "30s=FILE"
  std::string resume;              // a file; empty: the run begins at its start
};

void add_checkpoint_options(Command& command, CheckpointArguments& arguments);
/// Options that say nothing here.
void require_checkpoint_effect(const Command& command, const CheckpointArguments& arguments, bool virtual_clock);

/// Where a run is to be saved.
struct Save {
  Duration at{};
  std::string file;
};

/// Throws InputError.
std::vector<Save> parse_saves(const std::vector<std::string>& words);

/// What a run goes on from; its profile, what it set, but for plugins, and its seed come before what is given here.
Checkpoint read_checkpoint(const std::string& file, Overrides& overrides, std::uint64_t& seed);

}  // namespace jarol::tools

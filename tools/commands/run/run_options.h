// What `jarol run` is asked for.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "graph/language/load.h"
#include "tools/commands/run/checkpoints.h"
#include "tools/commands/run/load_graph.h"
#include "tools/commands/run/real_time.h"
#include "tools/commands/run/record_options.h"
#include "tools/commands/run/run_files.h"
#include "tools/console/options.h"

namespace jarol::tools {

struct RunArguments {
  std::string file;
  Overrides overrides;
  std::string duration;
  std::uint64_t seed = 0;
  std::size_t workers = 1;
  std::string clock = "virtual";
  std::string concurrency = "exotasks";
  RealTimeArguments real_time;
  bool json = false;
  RunFileArguments files;
  CheckpointArguments checkpoints;
  RecordArguments recording;
  std::vector<std::string> what_if;
  std::string execution;
  bool guard = false;
  ConsoleArguments console;
};

void add_run_options(Command& command, RunArguments& options);

// These throw InputError.

/// Refuses options that would have no effect.
void require_effect(const Command& command, const RunArguments& options);
/// None of the files that the command names replaces another.
void require_files_apart(const RunArguments& options, const std::vector<Save>& saves);
/// --for, else the end of the longest mission; on the real clock, or with an operator at the console, a graph without
/// one runs until it is interrupted.
Duration end_of_run(const RunArguments& options, const Loaded& loaded);

}  // namespace jarol::tools

// A whole run, and its replay, with all that is built in: what `jarol run` and `jarol replay` do, for a program.
//
//   const jarol::SourceSet sources;
//   jarol::Runner runner(jarol::load("dive.yaml"), {.end = 30s, .recording = {.file = "dive.mcap", .sources =
//   &sources}}); CHECK_FALSE(runner.run().verdict.is_negative()); jarol::RecordedRun log("dive.mcap");
//   CHECK(jarol::Replayer(log, jarol::built_in()).run().comparison.evidence == jarol::Evidence::same);
#pragma once

#include <cstdint>
#include <string>

#include "distributers/session/replayer.h"
#include "distributers/session/runner.h"
#include "distributers/session/what_if.h"
#include "tools/library/built_in.h"

namespace jarol {

/// As load_graph: a graph's file with what it may name, and its external systems. The overrides and the seed stand in
/// the options of its run, too. Throws SpecError with all that is wrong with the file, the overrides and the links;
/// WrongBuild.
Loaded load(const std::string& path, const Overrides& overrides = {}, std::uint64_t seed = 0,
            const NoteSink& note = no_notes, const BuildOptions& program = options_of_this_file());

}  // namespace jarol

// What a run is to do beside its graph.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "distributers/session/note_sink.h"
#include "distributers/session/pace.h"
#include "distributers/session/recording_options.h"
#include "distributers/session/run_words.h"
#include "distributers/session/saved_run.h"
#include "graph/language/load.h"
#include "runtime/dispatch/task_guard.h"
#include "runtime/machine/real_clock.h"

namespace jarol {

/// All that is named by a pointer outlives the run.
struct RunOptions {
  Duration end{};  // it covers the instants before it, unless a fault stops it; the greatest there is: until it is
                   // asked to end
  Overrides overrides{};  // with which the graph was loaded, and the seed
  std::uint64_t seed = 0;
  std::vector<std::string> fed{};  // what a program feeds in place of links, by name
  bool real_clock = false;         // against the machine's clock; else as fast as possible
  bool threads = false;     // on the real clock: the Jarol core on ordinary threads; nothing is claimed of its digest
  std::size_t workers = 1;  // threads that run tasks on the virtual clock; the outcome is the same for any number
  RealTimeOptions real_time{};  // on the real clock: priority and CPUs
  bool force = false;           // on the real clock: also what check has a negative verdict on
  bool note_force = false;      // `note` gets that verdict
  std::string no_guardian{};    // on the real clock: why no process hands over `safe` when this one is gone; empty: one
                                // does
  std::string execution{};      // on the virtual clock, what activations take: wcet, random, a file; empty: no time
  RecordingOptions recording{};
  std::vector<Stop> stops{};            // where it is saved on its way, on the virtual clock
  const Checkpoint* resumed = nullptr;  // what it goes on from; null: it begins at its start
  std::string resumed_from{};           // the file of that, as messages name it
  Pace* pace = nullptr;                 // on the virtual clock beside the wall clock; null: as fast as possible
  TaskGuard* guard = nullptr;           // on the virtual clock: tasks write nowhere but into their own memory
  std::vector<RecordSink*> sinks{};     // get all that is published
  bool truth = false;                   // the sinks get where all vehicles truly are
  bool watched = false;                 // the sinks show people what goes on: soon
  NoteSink note = no_notes;             // gets what is worth knowing and no error
  RunWords words{};                     // of messages
};

}  // namespace jarol

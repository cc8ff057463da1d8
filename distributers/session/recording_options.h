// How a run is recorded.
#pragma once

#include <cstdint>
#include <string>

#include "graph/language/duration.h"
#include "graph/language/source_set.h"
#include "runtime/mcap/compression.h"

namespace jarol {

/// The recording of a run, an MCAP file.
struct RecordingOptions {
  std::string file{};        // empty: there is none
  std::string what = "all";  // which outputs: all, names with * for any part, or inputs: what a replay needs
  std::uint64_t split = 0;   // a new file begins at so many bytes; 0: never
  Duration checkpoints{};    // the run is saved in it at each multiple of this; zero: never
  std::string version{};     // of the program, a line each
  mcap::Compression compression = mcap::Compression::lz4;
  const SourceSet* sources = nullptr;  // made before the graph was loaded: the files that a replay reads; null: those
                                       // of the graph and of its links alone
};

}  // namespace jarol

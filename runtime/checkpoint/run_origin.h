// What a run was made of: only one that was made of the same goes on from its checkpoint.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "graph/language/load.h"
#include "graph/values/archive.h"

namespace jarol {

struct RunOrigin {
  struct File {
    std::string name;
    std::uint64_t sum = 0;  // of its text
    void serialize(Archive& archive) { archive(name, sum); }
  };

  std::vector<File> files;       // the graph first, then what its links name
  std::string profile;           // of the graph; empty: none
  std::vector<std::string> set;  // "path=value"
  std::uint64_t seed = 0;
  std::vector<std::string> fed;  // distributers and communicators that a program feeds
  /// The program and its libraries, plugins among them: file name and what its linker calls this build of it.
  std::vector<std::pair<std::string, std::string>> program;

  void serialize(Archive& archive) { archive(files, profile, set, seed, fed, program); }
};

RunOrigin::File file_of(const Source& source);

/// Does "path=value" change nothing but parameters of a task?
bool sets_parameters(const std::string& set);

/// Why a run that was made so can't go on as one that is made like that, as in "is of seed 7"; empty: it can.
/// Parameters may differ.
std::string find_difference(const RunOrigin& saved, const RunOrigin& here);

/// Of this process: the program, then its libraries in the order in which they were loaded.
std::vector<std::pair<std::string, std::string>> find_program();

}  // namespace jarol

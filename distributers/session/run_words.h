// How messages name the options of a run.
#pragma once

#include <string>

namespace jarol {

/// What a message asks to be changed, as it is called where it comes from; by default in a C++ program.
struct RunWords {
  std::string priority = ".real_time.priority";
  std::string cpus = ".real_time.cpus";
  std::string set = ".set";
  std::string force = ".force";
  std::string workers = ".workers";
  std::string execution = ".execution";
  std::string checkpoints = ".recording.checkpoints";
  std::string end = ".end = 100s";
  std::string real_clock = ".real_clock = true";
  // of a replay
  std::string only = ".only";
  std::string from = ".from";
  std::string graph = ".file";  // how its graph is named
};

}  // namespace jarol

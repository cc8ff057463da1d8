// Some tasks of a graph by themselves: what the others and the communicators gave them comes from a recording.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "distributers/session/load.h"
#include "runtime/record/recorded_run.h"

namespace jarol {

/// A graph of these tasks only. Each output of another that they read is an `in` communicator of its name, which takes
/// at each instant what the recording has of it then.
class OnlyTasks {
 public:
  /// Throws InputError where a task is not in the graph, or the recording lacks what one of them reads or
  /// publishes, or has it with another type. The recording outlives it.
  OnlyTasks(const Graph& graph, const std::vector<std::string>& tasks, const Recording& recording);

  /// Once: it and this object outlive the run.
  Loaded take();
  /// Of the misses of the graph those of these tasks.
  std::vector<Miss> misses_of(const std::vector<Miss>& misses) const;
  /// Names of the outputs of these tasks.
  const std::vector<std::string>& outputs() const { return outputs_; }

 private:
  void require_recorded(const std::string& output, const Type& type) const;
  void keep_tasks(const Graph& graph, const std::vector<std::string>& names);
  void connect(const Graph& graph);
  void add_source(const Graph& graph, const End& from, const Type& type);

  const Recording& recording_;
  std::vector<std::size_t> kept_;  // by task of the graph: its index here, or none
  DistributerClass recorded_;      // a channel for each communicator
  Loaded made_;
  std::vector<std::string> outputs_;
};

}  // namespace jarol

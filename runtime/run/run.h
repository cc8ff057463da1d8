// One run of a plan and what comes of it: what all share who have a part in running it.
#pragma once

#include "runtime/run/faults.h"
#include "runtime/run/input_log.h"
#include "runtime/run/publisher.h"
#include "runtime/run/report.h"
#include "runtime/state/run_state.h"

namespace jarol {

struct Run {
  struct Options {
    bool digest = true;
    Recorder* recorder = nullptr;  // of publications
    Recorder* log = nullptr;       // of what a replay needs
    bool may_rest = false;         // the vehicle is brought to rest if the graph states how
  };

  Run(PlanOfRun of, const Options& options);

  const PlanOfRun shared_plan;
  const Plan& plan;
  const Graph& graph;
  const bool may_rest;
  RunState state;
  Report report;
  Publisher publisher;
  InputLog log;
  Faults faults;
};

}  // namespace jarol

// Who attends a run.
#pragma once

#include <functional>

#include "distributers/session/note_sink.h"
#include "runtime/execute/attend.h"

namespace jarol {

/// What asks it to end, and who is told of it on its way.
struct Attendant {
  std::function<Wish()> wish = [] { return Wish{}; };
  NoteSink note = no_notes;  // likewise of what comes up on the way: it waits for nobody
  std::function<void(const Ending&)> on_rest = [](const Ending&) {};
  std::function<void()> on_end = [] {};
  StuckNote on_stuck{};
};

}  // namespace jarol

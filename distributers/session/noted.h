// What a run's report shows beside counts and verdicts: what operators were shown, and what tasks logged.
#pragma once

#include <vector>

#include "distributers/session/logged_texts.h"
#include "distributers/session/status_events.h"

namespace jarol {

struct Noted {
  explicit Noted(const Graph& graph) : reported(graph), logged(graph) {}

  /// Those of both that have anything to note.
  void add_to(std::vector<RecordSink*>& sinks) {
    if (reported.can_be_any()) sinks.push_back(&reported);
    if (logged.can_be_any()) sinks.push_back(&logged);
  }

  void serialize(Archive& archive) { archive(reported, logged); }

  StatusEvents reported;
  LoggedTexts logged;
};

}  // namespace jarol

// What a vehicle reported of its own decisions during a run, and what tasks logged, in the run's report.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "distributers/session/logged_texts.h"
#include "distributers/session/status_events.h"

namespace jarol::tools {

/// A line per event, which names what changed, and its meaning; all of them as an array.
std::string to_text(const StatusEvents::Kept& kept);
nlohmann::ordered_json to_json(const StatusEvents::Kept& kept);

/// A line per text; all of them as an array.
std::string to_text(const LoggedTexts::Kept& kept);
nlohmann::ordered_json to_json(const LoggedTexts::Kept& kept);

}  // namespace jarol::tools

// What the loader and `check` say of a text that is edited, as a page gets it.
#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "graph/language/source.h"
#include "tools/commands/run/load_graph.h"

namespace jarol::tools::edit {

struct EditedText {
  std::shared_ptr<const Source> source;  // named by the path of the file, so that paths within are right
  Overrides overrides;                   // a profile, or none
};

/// Plugins are code: of a text that is not saved those are loaded that the saved one names, `allowed`. Empty: the text
/// names no others; else why they are refused.
std::string refused_plugins(const Source& text, const std::vector<std::string>& allowed);
/// Throws SpecError where the text can be read and has no such profile; empty: none is needed.
void require_profile(const std::shared_ptr<const Source>& source, const std::string& profile);
/// Paths as the text has them.
std::vector<std::string> plugins_of(const std::shared_ptr<const Source>& source);

/// `problems` where it does not load, else `check` as of jarol check --json, and its `report`.
nlohmann::ordered_json judge(const EditedText& text);

/// Where all that the text says stands in a drawing, also where it does not load: `drawing`, or why there is none; and
/// the `connections` in the order of the text.
nlohmann::ordered_json draw(const EditedText& text);

/// What would turn a "no" into a "yes", each with its `text` and what it would `set`. Takes longer than the others.
nlohmann::ordered_json suggest(const EditedText& text);

}  // namespace jarol::tools::edit

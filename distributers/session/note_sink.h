// What is worth knowing and no error: who opens a session decides where it goes.
#pragma once

#include <functional>
#include <string>

namespace jarol {

/// Called with a sentence, lower case, no full stop.
using NoteSink = std::function<void(const std::string& text)>;

inline void no_notes(const std::string&) {}

}  // namespace jarol

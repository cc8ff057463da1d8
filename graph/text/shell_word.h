// Commands that a message tells the user to give.
#pragma once

#include <string>

namespace jarol {

/// What a shell takes as one word.
std::string shell_word(const std::string& text);

}  // namespace jarol

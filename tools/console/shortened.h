// What a page has sent, as it is said back to it.
#pragma once

#include <string>

#include "graph/text/escape.h"

namespace jarol::tools::console {

/// Printable, and no longer than a name is.
inline std::string shortened(const std::string& text) {
  constexpr std::size_t longest = 60;
  return text.size() <= longest ? printable(text) : printable(text.substr(0, longest)) + "...";
}

}  // namespace jarol::tools::console

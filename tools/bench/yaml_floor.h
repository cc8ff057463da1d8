// The floor of loading: yaml-cpp's own parse of the same text.
#pragma once

#include <string>

namespace jarol::bench {

/// Parses into yaml-cpp's tree and returns the number of its top keys.
double parse_only(const std::string& text);

}  // namespace jarol::bench

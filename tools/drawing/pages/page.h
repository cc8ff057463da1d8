// A page for people as one HTML file that asks the network for nothing: style sheet, scripts and data stand in it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace jarol::tools {

/// `scripts`: modules of this room, each after those that it imports; the last one makes the page from `data`. Numbers
/// that are not finite are null there.
std::string page_of(const std::string& title, const std::vector<std::string_view>& scripts,
                    const nlohmann::ordered_json& data);

/// The bytes of these doubles in base64: to the bit, and shorter than their digits.
std::string base64_of(std::span<const double> numbers);

}  // namespace jarol::tools

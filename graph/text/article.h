// Words of messages as English has them.
#pragma once

#include <string>

namespace jarol {

/// "a double", "an int32", "a uint32".
std::string with_article(const std::string& noun);

}  // namespace jarol

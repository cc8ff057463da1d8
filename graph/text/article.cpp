#include "graph/text/article.h"

#include <string_view>

namespace jarol {

std::string with_article(const std::string& noun) {
  constexpr std::string_view vowels = "aeiouAEIO";
  const bool an = !noun.empty() && vowels.find(noun[0]) != std::string_view::npos && !noun.starts_with("uint");
  return (an ? "an " : "a ") + noun;
}

}  // namespace jarol

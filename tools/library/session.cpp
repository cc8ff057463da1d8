#include "tools/library/session.h"

#include "tools/library/built_in.h"

namespace jarol {

Session open(const std::string& path, SessionOptions options) { return {built_in(), path, std::move(options)}; }

Session open_text(std::string text, SessionOptions options, const std::string& folder) {
  auto source = std::make_shared<const Source>(Source{folder + "/graph", std::move(text)});
  return {built_in(), std::move(source), std::move(options)};
}

}  // namespace jarol

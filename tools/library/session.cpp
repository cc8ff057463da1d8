#include "tools/library/session.h"

#include "tools/library/built_in.h"

namespace jarol {

Session open(const std::string& path, SessionOptions options, const BuildOptions& program) {
  return {built_in(program), path, std::move(options)};
}

Session open_text(std::string text, SessionOptions options, const std::string& folder, const BuildOptions& program) {
  const distributers::Registries& known = built_in(program);
  auto source = std::make_shared<const Source>(Source{folder + "/graph", std::move(text)});
  return {known, std::move(source), std::move(options)};
}

}  // namespace jarol

#include "tools/library/check.h"

namespace jarol {

CheckedGraph check(const std::string& path, const CheckOptions& options, const BuildOptions& program) {
  return check_graph(read_source(path), built_in(program), options);
}

}  // namespace jarol

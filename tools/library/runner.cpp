#include "tools/library/runner.h"

namespace jarol {

Loaded load(const std::string& path, const Overrides& overrides, std::uint64_t seed, const NoteSink& note,
            const BuildOptions& program) {
  return load_graph(read_source(path), built_in(program), overrides, seed, note);
}

}  // namespace jarol

// Coverage-guided: any bytes as a graph. Build with -DJAROL_FUZZ=ON and clang, run: load_fuzz -max_len=4096 CORPUS
// specs
#include <cstddef>
#include <cstdint>

#include "tests/graph/graph_of.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static_cast<void>(jarol::tests::report_on(std::string(reinterpret_cast<const char*>(data), size)));
  return 0;
}

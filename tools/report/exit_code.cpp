#include "tools/report/exit_code.h"

#include <algorithm>

namespace jarol::tools {
namespace {

int weight_of(int code) {
  switch (code) {
    case exit_good: return 0;
    case exit_negative: return 1;
    case exit_unfinished: return 3;
    case exit_input: return 4;
    default: return 2;
  }
}

}  // namespace

int exit_of_signal(int signal) { return signal == 0 ? int{exit_good} : 128 + signal; }

int exit_of(std::initializer_list<int> codes) {
  return std::max(codes, [](int a, int b) { return weight_of(a) < weight_of(b); });
}

}  // namespace jarol::tools

// What of a process' arithmetic may depend on the processor: functions of <math.h> that are not graph/math's, and BLAS.
#pragma once

#include <string>
#include <vector>

namespace jarol {

struct Arithmetic {
  /// Calls that end elsewhere, as "libSimTKmath.so.3.7 calls sin of libm.so.6": none, unless something stands before
  /// the program in the order of look-up, or a plugin calls what graph/math does not have, "tgamma".
  std::vector<std::string> foreign_calls;
  /// The file of the BLAS that is loaded, if any, and whether it is one that picks its code by processor.
  std::string blas;
  bool blas_varies = false;
};

/// Looks through what is loaded now, and where its calls lead.
Arithmetic find_arithmetic();

/// One line for each thing that may make the digest another on another processor.
std::vector<std::string> warnings(const Arithmetic& arithmetic);

}  // namespace jarol

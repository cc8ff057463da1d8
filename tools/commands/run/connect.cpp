#include "tools/commands/run/connect.h"

#include <stdexcept>
#include <string>

#include "tools/commands/run/interrupt.h"
#include "tools/report/failure.h"

namespace jarol::tools {

void connect_unless_ended(const std::function<void()>& connect) {
  try {
    connect();
  } catch (const std::runtime_error& error) {
    if (Interruptible::signal() == 0) throw;
    throw EndedEarly(Interruptible::signal(), std::string("interrupted before the run began: ") + error.what());
  }
}

}  // namespace jarol::tools

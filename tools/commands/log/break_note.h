// What breaks off is shown as far as it goes, and that is said beside it.
#pragma once

#include <iostream>
#include <string>

#include "graph/text/escape.h"
#include "runtime/record/recording.h"

namespace jarol::tools {

/// To stderr, where the recording of that name is not whole.
inline void note_break(const Recording& recording, const std::string& name) {
  if (recording.is_whole()) return;
  std::cerr << "note: '" << printable(name) << "' breaks off " << printable(recording.text_of_break())
            << ": this is what there is before\n";
}

}  // namespace jarol::tools

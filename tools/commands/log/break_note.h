// What breaks off or is damaged is shown as far as it goes, and that is said beside it.
#pragma once

#include <iostream>
#include <string>

#include "graph/language/quantities.h"
#include "graph/text/escape.h"
#include "runtime/record/recorded_run.h"
#include "runtime/record/recording.h"
#include "tools/report/exit_code.h"

namespace jarol::tools {

/// Of the recording of that name, which is not whole: it was brought to its end, by its index, and is damaged; else its
/// run could not write on.
inline bool is_damaged(const std::string& name) { return Recording(name).is_whole(); }

/// Of one that is not whole, as in "breaks off at byte 100" or "is damaged at byte 100".
inline std::string break_text(const Recording& recording, bool damaged) {
  return (damaged ? "is damaged " : "breaks off ") + printable(recording.text_of_break());
}

/// To stderr, where the recording of that name is not whole. The exit code of who shows what there is.
inline int note_break(const Recording& recording, const std::string& name) {
  if (recording.is_whole()) return exit_good;
  const bool damaged = is_damaged(name);
  std::cerr << (damaged ? "error: '" : "note: '") << printable(name) << "' " << break_text(recording, damaged)
            << ": this is what there is before\n";
  return damaged ? exit_negative : exit_good;
}

/// To stderr, where something follows its end, as another recording does that was joined to it.
inline void note_rest(const Recording& recording, const std::string& name) {
  if (const std::string rest = recording.text_of_rest(); !rest.empty())
    std::cerr << "note: '" << printable(name) << "' " << printable(rest) << "\n";
}

/// To stderr, of what is missing on the way; of one that is shown as a table or compared. Throws LogError.
inline void note_gaps(const Recording& recording, const std::string& name) {
  for (const Gap& gap : read_gaps(recording))
    std::cerr << "note: '" << printable(name) << "' lacks " << gap.values << " published values from "
              << seconds_text(Duration(gap.from)) << " s to " << seconds_text(Duration(gap.to))
              << " s, which came faster than the disk took them\n";
}

}  // namespace jarol::tools

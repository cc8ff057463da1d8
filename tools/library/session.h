// jarol::open: a session with all that is built in.
//
//   auto session = jarol::open("specs/exolauv.yaml", {.profile = "at_sea", .seed = 7});
//   session.run_until(30s);
//   CHECK(session.report().digest == ...);
#pragma once

#include <string>

#include "distributers/session/session.h"

namespace jarol {

/// Throws as Session's constructor does.
Session open(const std::string& path, SessionOptions options = {},
             const BuildOptions& program = options_of_this_file());

/// The same of a text in place of a file; paths in it are relative to `folder`.
Session open_text(std::string text, SessionOptions options = {}, const std::string& folder = ".",
                  const BuildOptions& program = options_of_this_file());

}  // namespace jarol

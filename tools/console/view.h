// A page that shows a run, as the run sees it: so that a program that runs can be built without pages.
#pragma once

#include <string>

#include "runtime/record/sink.h"

namespace jarol::tools::console {

class View {
 public:
  virtual ~View() = default;
  /// From now on pages are served, with what came before, too. Throws where the server can't be had.
  virtual void open() = 0;
  /// Once it is open.
  virtual const std::string& url() const = 0;
  /// For whoever looks on at the run.
  virtual RecordSink& feed() = 0;
  /// The run has ended, as these lines say.
  virtual void end(const std::string& text) = 0;
};

}  // namespace jarol::tools::console

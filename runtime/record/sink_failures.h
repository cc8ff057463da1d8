// What the sinks of a recorder have thrown.
#pragma once

#include <exception>
#include <string>
#include <vector>

#include "runtime/record/sink.h"

namespace jarol {

/// By one thread at a time.
class SinkFailures {
 public:
  /// While it is caught; null: it is of all sinks.
  [[gnu::cold]] void note(const RecordSink* sink);

  /// Empty: nothing.
  std::string of(const RecordSink& sink) const;
  /// Throws the first.
  void rethrow_first() const;
  /// Throws it, or, of several, Unfinished with all of it.
  void rethrow_all() const;

 private:
  struct Failed {
    const RecordSink* sink;
    std::string why;
  };
  std::exception_ptr first_;
  std::vector<Failed> failed_;
};

}  // namespace jarol

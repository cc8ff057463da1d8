// Where machine code comes from in the source, as debug data has it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "graph/isolation/object.h"

namespace jarol::isolation {

struct Frame {
  std::string function;  // as in the source; empty: not known
  std::string file;      // empty: not known
  int line = 0;
};

class SourceLines {
 public:
  explicit SourceLines(const std::string& path);
  ~SourceLines();
  SourceLines(const SourceLines&) = delete;
  SourceLines& operator=(const SourceLines&) = delete;

  /// The function at an address and those that were inlined there, the outermost first, each with the line that leads
  /// to the next. One frame without a file: there is no debug data.
  std::vector<Frame> frames_at(Address address) const;

 private:
  struct Reader;
  std::unique_ptr<Reader> reader_;
};

}  // namespace jarol::isolation

// Where a piece of input stands: the text it was read from, and line and column in it.
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace jarol {

/// A text that was read: a file, or the argument of an option.
struct Source {
  std::string name;  // as shown before the line number
  std::string text;
};

/// A place in a source, line and column counted from 1. No source: a place nowhere, for what only a program made.
struct Location {
  std::shared_ptr<const Source> source;
  int line = 0;
  int column = 0;
};

/// The line without its end, or nothing if there is no such line.
std::string_view line_of(const Source& source, int line);

}  // namespace jarol

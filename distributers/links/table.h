// Time-stamped rows of a CSV, as scripts are written.
#pragma once

#include <string>
#include <vector>

#include "graph/language/problems.h"
#include "graph/values/type_of.h"

namespace jarol::distributers {

/// A title row, the first of it `time`, then rows whose times (s) grow from 0 on; before it lines `expect: CONDITION`
/// may stand, of which no more is known here. Lines that are empty or begin with # are left out.
struct Table {
  struct Cell {
    std::string text;  // may be empty
    Location where;
  };
  struct Row {
    Duration time{};
    std::vector<Cell> cells;  // as many as titles
  };
  std::vector<Cell> expectations;  // each a condition, up to where " #" begins a comment
  std::vector<Cell> titles;        // without `time`
  std::vector<Row> rows;
};

/// What is wrong goes to `problems`, with file, line and column; rows that are wrong are left out.
Table read_table(const std::shared_ptr<const Source>& source, Problems& problems);

}  // namespace jarol::distributers

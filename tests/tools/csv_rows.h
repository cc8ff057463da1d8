// The numbers of a CSV file with a title row.
#pragma once

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace command {

/// Rows of numbers, without comments and titles; an empty cell is NaN.
inline std::vector<std::vector<double>> rows_of(const std::string& path) {
  std::vector<std::vector<double>> rows;
  std::ifstream file(path);
  bool titled = false;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    if (titled) {
      rows.emplace_back();
      std::istringstream cells(line);
      for (std::string cell; std::getline(cells, cell, ',');)
        rows.back().push_back(cell.empty() ? std::nan("") : std::stod(cell));
    }
    titled = true;
  }
  return rows;
}

}  // namespace command

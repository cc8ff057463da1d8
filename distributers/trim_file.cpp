#include "distributers/trim_file.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "graph/yaml/quantities.h"

namespace jarol::distributers {
namespace {

// The rest of a line that begins with a name, as a number of rad.
double read_line(std::ifstream& file, const std::string& name, const std::string& path) {
  std::string line;
  double number = 0;
  if (!std::getline(file, line) || !line.starts_with(name + " ") ||
      !parse_number(std::string_view(line).substr(name.size() + 1), "rad", number).empty() || std::abs(number) > 1)
    throw std::invalid_argument("'" + path +
                                "' is no trim file; it needs a line 'roll' and a line 'pitch', each with a "
                                "number of rad from -1 to 1");
  return number;
}

}  // namespace

Trim read_trim(const std::string& path) {
  if (!std::filesystem::exists(path)) return {};
  std::ifstream file(path);
  Trim trim;
  trim.roll = read_line(file, "roll", path);
  trim.pitch = read_line(file, "pitch", path);
  return trim;
}

// written beside it and put in its place, so that a crash leaves the one or the other
void write_trim(const std::string& path, const Trim& trim) {
  const std::string beside = path + ".new";
  std::ofstream file(beside);
  file << "roll " << number_text(trim.roll) << "\npitch " << number_text(trim.pitch) << "\n";
  file.close();
  if (!file || std::rename(beside.c_str(), path.c_str()) != 0)
    throw std::runtime_error("can't write the trim to '" + path + "'");
}

}  // namespace jarol::distributers

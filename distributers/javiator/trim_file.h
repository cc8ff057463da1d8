// The trim of the helicopter from one flight to the next.
#pragma once

#include <string>

namespace jarol::distributers {

/// Roll and pitch that count as level, rad.
struct Trim {
  double roll = 0, pitch = 0;

  friend bool operator==(const Trim&, const Trim&) = default;
};

/// The trim that the file keeps; none, where there is no such file. Throws InputError if it is no trim file.
Trim read_trim(const std::string& path);

/// Replaces the file as a whole. Throws InputError if that can't be.
void write_trim(const std::string& path, const Trim& trim);

}  // namespace jarol::distributers

// The files that this process has read: what it writes must not take their place.
#pragma once

#include <sys/stat.h>

#include <string>
#include <vector>

namespace jarol {

/// A regular file was read, or loaded as a library; others are not kept.
void note_input(const std::string& path, const struct stat& status);
void note_input(const std::string& path);

/// All of them that are still there, by name.
std::vector<std::string> inputs_read();

/// What the input is called that stands at that path, also by links and under other names; none: empty.
std::string input_at(const std::string& path);

}  // namespace jarol

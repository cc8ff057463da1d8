// What is no regular file, as a device, a FIFO or stdout, is written where it is.
#pragma once

#include <cstdio>
#include <string>

namespace jarol {

/// Waits for whoever reads: a FIFO until one has opened it, and what is written until there is room. Once the process
/// has been asked to end (asked_to_end.h) only for a moment: then writing fails with ETIMEDOUT. Null, and errno, if it
/// can't be opened.
std::FILE* open_in_place(const std::string& path);

/// The same of what is open; another descriptor of it is made.
std::FILE* open_in_place(int descriptor);

}  // namespace jarol

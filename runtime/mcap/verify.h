// Is an MCAP file that mcap::Writer has written as it was, byte for byte?
#pragma once

#include <string>
#include <vector>

namespace jarol::mcap {

/// What is wrong, each with the byte where, in order; nothing: every byte is covered by a check sum that is right, and
/// indexes and counts are those of what is there. Throws FormatError where it is no MCAP file, std::system_error where
/// it can't be read.
std::vector<std::string> verify(const std::string& path);

}  // namespace jarol::mcap

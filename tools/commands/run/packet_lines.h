// Packets as lines of text: hexadecimal digits on one side, JSON objects on the other.
#pragma once

#include <iosfwd>

#include "distributers/messages/message_set.h"

namespace jarol::tools {

/// Turns each line of hexadecimal digits, which are one packet, into one JSON object a line: {"name", "header",
/// "fields", "crc_ok", "hex"}, and "order" where it is not the set's own. What is wrong with a line goes to `errors`
/// with its number, and the rest goes on. Returns the command's exit code: 2 if a line could not be read, else 1 if a
/// checksum was wrong, else 0.
int decode_lines(const messages::MessageSet& set, std::istream& in, std::ostream& out, std::ostream& errors);

/// The other way: of an object only "name" is needed; sync, id, size and checksum are set here.
int encode_lines(const messages::MessageSet& set, std::istream& in, std::ostream& out, std::ostream& errors);

}  // namespace jarol::tools

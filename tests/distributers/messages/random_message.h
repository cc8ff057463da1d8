// Messages of any form with random values in all their fields.
#pragma once

#include <random>

#include "distributers/messages/message.h"

namespace jarol::messages {

/// Nested messages are of what may stand in their field, with fields of their own but without messages in these if
/// `depth` is 0.
Message random_message(const MessageDescriptor& descriptor, std::mt19937_64& random, int depth = 2);

/// Writes a message of every form of the set, `times` each, in every byte order of the set; reads it back; turns it to
/// JSON and back. Returns what went wrong first, or nothing.
std::string round_trip(const MessageSet& set, std::mt19937_64& random, int times);

}  // namespace jarol::messages

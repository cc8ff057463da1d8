// Messages as JSON text: the form in which people and other programs read and write them.
#pragma once

#include <string>
#include <string_view>

#include "distributers/messages/message.h"

namespace jarol::messages {

/// The fields of a message as one JSON object, in their order. Numbers as exactly as doubles go; what is not finite as
/// "NaN", "Infinity" or "-Infinity", other NaNs as their bits, "0x7fc00001"; texts as strings, or as {"hex"} if they
/// are no UTF-8; bytes as hexadecimal digits; arrays as such, those of ASCII digits as a number if they are one; a
/// nested message as {"abbrev", "mgid", "fields"}, none as null.
std::string to_json(MessageRef message);

/// Sets fields of a message from a JSON object in that form; enumerators may stand by their names, bits as a list of
/// names. Fields that are not named keep their values. False if it can't be read: then `why` says what is wrong.
bool from_json(std::string_view object, Message& message, std::string& why);

}  // namespace jarol::messages

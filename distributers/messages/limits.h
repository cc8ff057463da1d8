// What a definition says of the least and greatest values of its fields, against what a message holds.
#pragma once

#include <string>
#include <vector>

#include "distributers/messages/message.h"

namespace jarol::messages {

/// Numbers of the message that lie outside `min` or `max` of their fields, each as "points[2].lat: 2 is above 1.57".
/// What is no number at all lies nowhere. Limits are the sender's promise: packets that break it are taken like others.
std::vector<std::string> find_outside(MessageRef message);

}  // namespace jarol::messages

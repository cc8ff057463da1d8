// The time in the headers of packets, where a message set has one.
#pragma once

#include "distributers/messages/message_set.h"

namespace jarol::distributers {

/// By the system's clock.
double seconds_since_1970();

/// The field of a set's header that is the time, in s since 1970; null: there is none.
const messages::FieldDescriptor* find_timestamp(const messages::MessageSet& set);

/// Has the header that lies there say that it is now; nothing without a field.
void set_timestamp(const messages::FieldDescriptor* field, void* header);

}  // namespace jarol::distributers

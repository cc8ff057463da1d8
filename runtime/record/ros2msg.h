// The schema of a value's type as ROS 2 writes message definitions.
#pragma once

#include <string>

#include "graph/values/type.h"

namespace jarol {

struct MessageSchema {
  std::string name;  // as in "jarol/msg/Moment"
  std::string text;  // its fields, then the definitions of the structs in them
};

/// A value that is no struct is the field `value` of a message. A string, which may hold any bytes, is uint8[], a
/// duration its nanoseconds, an enumeration its integer with the enumerators as constants. An array or sequence of what
/// ROS has no arrays of is one of a struct with the field `values`.
MessageSchema schema_of(const Type& type);

}  // namespace jarol

// The functions of this room by name, for who looks whether all calls end here.
#pragma once

#include <span>

namespace jarol::math {

struct Named {
  const char* name;
  const void* address;
};

std::span<const Named> names();

}  // namespace jarol::math

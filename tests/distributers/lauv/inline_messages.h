// Messages within messages.
#pragma once

#include <doctest/doctest.h>

#include "distributers/messages/payload.h"

namespace jarol::tests {

template <class M>
messages::InlineMessage packed(const M& m) {
  messages::InlineMessage to;
  REQUIRE(messages::put_inline(messages::refer_to(m), to));
  return to;
}

}  // namespace jarol::tests

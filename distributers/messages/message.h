// A message of a message set, passed by reference: the same whether it came over a socket or from a vehicle in process.
#pragma once

#include "graph/values/type_of.h"

namespace jarol::messages {

/// A message where it lies; whoever keeps it copies it.
struct MessageRef {
  const Type* type = nullptr;
  const void* value = nullptr;

  /// The message as an M, or null if it is another.
  template <class M>
  const M* as() const {
    return type == &type_of<M>() ? static_cast<const M*>(value) : nullptr;
  }
};

template <class M>
MessageRef refer_to(const M& message) {
  return {&type_of<M>(), &message};
}

/// Takes messages one by one as they arrive.
class Receiver {
 public:
  virtual ~Receiver() = default;
  virtual void receive(MessageRef message) = 0;
};

}  // namespace jarol::messages

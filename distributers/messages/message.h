// A message of a message set: one passed by reference, the same whether it came over a socket or from a vehicle in
// process, and one that is kept.
#pragma once

#include <memory>

#include "distributers/messages/descriptor.h"

namespace jarol::messages {

/// A message where it lies; whoever keeps it copies it.
struct MessageRef {
  const MessageDescriptor* descriptor = nullptr;
  const void* value = nullptr;
  const void* header = nullptr;  // of its packet, in the form that its set has; null: it came in none

  /// The message as an M, or null if it is another.
  template <class M>
  const M* as() const {
    return static_cast<const M*>(if_of(M::descriptor));
  }
  // out of line: g++ 12 would look at the value as the wrong type, and warn
  const void* if_of(const MessageDescriptor& wanted) const;
};

template <class M>
MessageRef refer_to(const M& message) {
  return {&M::descriptor, &message, nullptr};
}

/// A message of a form known at run time only, in memory of its own.
class Message {
 public:
  Message() = default;
  /// The default message of that form.
  explicit Message(const MessageDescriptor& descriptor);
  explicit Message(MessageRef message);
  Message(const Message& other) : Message(MessageRef(other)) {}
  Message& operator=(const Message& other) { return *this = Message(other); }
  Message(Message&&) = default;
  Message& operator=(Message&&) = default;
  ~Message() = default;

  const MessageDescriptor* descriptor() const { return descriptor_; }
  void* value() { return memory_.get(); }
  const void* value() const { return memory_.get(); }
  operator MessageRef() const { return {descriptor_, memory_.get(), nullptr}; }

  template <class M>
  const M* as() const {
    return MessageRef(*this).as<M>();
  }

 private:
  struct Release {
    const MessageDescriptor* descriptor;  // not initialized here: a nested deleter must be complete without it
    void operator()(std::byte* memory) const;
  };
  const MessageDescriptor* descriptor_ = nullptr;
  std::unique_ptr<std::byte, Release> memory_;
};

/// Takes messages one by one as they arrive.
class Receiver {
 public:
  virtual ~Receiver() = default;
  virtual void receive(MessageRef message) = 0;
};

}  // namespace jarol::messages

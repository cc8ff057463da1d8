#include "distributers/messages/message.h"

#include <algorithm>

namespace jarol::messages {
namespace {

std::align_val_t alignment_of(const MessageDescriptor& descriptor) {
  return std::align_val_t{std::max<std::size_t>(descriptor.alignment, alignof(void*))};
}

}  // namespace

const void* MessageRef::if_of(const MessageDescriptor& wanted) const { return descriptor == &wanted ? value : nullptr; }

Message::Message(const MessageDescriptor& descriptor)
    : descriptor_(&descriptor),
      memory_(static_cast<std::byte*>(::operator new(descriptor.size, alignment_of(descriptor))),
              Release{&descriptor}) {
  descriptor.construct(memory_.get());
}

Message::Message(MessageRef message) {
  if (message.descriptor == nullptr) return;
  *this = Message(*message.descriptor);
  descriptor_->assign(value(), message.value);
}

void Message::Release::operator()(std::byte* memory) const {
  descriptor->destroy(memory);
  ::operator delete(memory, alignment_of(*descriptor));
}

}  // namespace jarol::messages

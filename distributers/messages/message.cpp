#include "distributers/messages/message.h"

#include <algorithm>

namespace jarol::messages {
namespace {

std::align_val_t alignment_of(const MessageForm& form) {
  return std::align_val_t{std::max<std::size_t>(form.alignment, alignof(void*))};
}

}  // namespace

const void* MessageRef::if_of(const MessageForm& wanted) const { return form == &wanted ? value : nullptr; }

Message::Message(const MessageForm& form)
    : form_(&form), memory_(static_cast<std::byte*>(::operator new(form.size, alignment_of(form))), Release{&form}) {
  form.construct(memory_.get());
}

Message::Message(MessageRef message) {
  if (message.form == nullptr) return;
  *this = Message(*message.form);
  form_->assign(value(), message.value);
}

void Message::Release::operator()(std::byte* memory) const {
  form->destroy(memory);
  ::operator delete(memory, alignment_of(*form));
}

}  // namespace jarol::messages

#include "graph/values/value.h"

#include <new>

namespace jarol {
namespace {
constexpr std::align_val_t alignment{64};
}

Value::Value(const Type& type)
    : type_(&type), memory_(static_cast<std::byte*>(::operator new(type.size, alignment)), Release{&type}) {
  type.construct(memory_.get());
}

Value::Value(const Value& other) { *this = other; }

Value& Value::operator=(const Value& other) {
  if (this == &other) return *this;
  if (other.type_ == nullptr) return *this = Value();
  *this = Value(*other.type_);
  copy_value(*type_, memory_.get(), other.memory_.get());
  return *this;
}

void Value::Release::operator()(std::byte* memory) const {
  if (type->destroy != nullptr) type->destroy(memory);
  ::operator delete(memory, alignment);
}

}  // namespace jarol

#include "graph/values/value.h"

#include <cstring>
#include <new>

namespace jarol {
namespace {
constexpr std::align_val_t alignment{64};
}

Value::Value(const Type& type) : type_(&type), memory_(static_cast<std::byte*>(::operator new(type.size, alignment))) {
  type.construct(memory_.get());
}

Value::Value(const Value& other) { *this = other; }

Value& Value::operator=(const Value& other) {
  if (this == &other) return *this;
  if (other.type_ == nullptr) return *this = Value();
  *this = Value(*other.type_);
  std::memcpy(memory_.get(), other.memory_.get(), type_->size);
  return *this;
}

void Value::Release::operator()(std::byte* memory) const { ::operator delete(memory, alignment); }

}  // namespace jarol

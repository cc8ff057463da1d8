// One value of a type that is known at run time only, in memory of its own.
#pragma once

#include <cstddef>
#include <memory>

#include "graph/values/type.h"

namespace jarol {

class Value {
 public:
  Value() = default;
  /// The default value of the type.
  explicit Value(const Type& type);
  Value(const Value& other);
  Value& operator=(const Value& other);
  Value(Value&&) = default;
  Value& operator=(Value&&) = default;
  ~Value() = default;

  const Type* type() const { return type_; }
  void* data() { return memory_.get(); }
  const void* data() const { return memory_.get(); }

 private:
  struct Release {
    const Type* type;  // not initialized here: a nested deleter must be complete without it
    void operator()(std::byte* memory) const;
  };
  const Type* type_ = nullptr;
  std::unique_ptr<std::byte, Release> memory_;
};

}  // namespace jarol

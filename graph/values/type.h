// What the runtime knows of a value's type: a tree of descriptions and the few operations on raw memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace jarol {

struct Type;

/// A described member of a struct type.
struct TypeField {
  std::string name;
  std::string unit;
  std::string text;
  std::size_t offset = 0;
  const Type* type = nullptr;
};

enum class Kind {
  boolean,
  signed_integer,
  unsigned_integer,
  floating,
  duration,     // whole nanoseconds
  enumeration,  // of the size of its underlying integer
  array,        // fixed arrays and fixed Eigen vectors
  structure,
};

/// A value's type. One object per C++ type lives for ever, made by `type_of<T>()`.
struct Type {
  std::string name;
  Kind kind = Kind::structure;
  std::size_t size = 0;       // bytes
  std::size_t alignment = 1;  // bytes

  std::vector<TypeField> fields;                                  // structure
  const Type* element = nullptr;                                  // array
  std::size_t count = 0;                                          // array
  std::vector<std::pair<std::string, std::int64_t>> enumerators;  // enumeration

  void (*construct)(void* to) = nullptr;                     // default value into raw memory
  bool (*finite)(const void* value) = nullptr;               // no infinity, no NaN in it
  std::uint64_t (*hash_words)(const void* value) = nullptr;  // the digest's sum over the value's words
};

/// True if both have the same name, layout and fields; plugins bring their own objects for equal types.
bool same_type(const Type& a, const Type& b);

/// The field of that name, or null.
const TypeField* find_field(const Type& type, std::string_view name);

/// Integer of a value of kind boolean, *_integer, duration or enumeration, sign- or zero-extended to 64 bits.
std::int64_t read_integer(const Type& type, const void* value);
void write_integer(const Type& type, void* value, std::int64_t integer);

/// Number of a value of kind floating.
double read_floating(const Type& type, const void* value);
void write_floating(const Type& type, void* value, double number);

}  // namespace jarol

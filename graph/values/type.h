// What the runtime knows of a value's type: a tree of descriptions and the few operations on raw memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "graph/values/field_range.h"

namespace jarol {

struct Type;

/// A described member of a struct type.
struct TypeField {
  std::string name;
  std::string unit;
  std::string text;
  std::size_t offset = 0;
  const Type* type = nullptr;
  FieldRange range{};  // of its number or numbers
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
  sequence,  // of any length
  string,    // of any length, in bytes
};

/// A value's type. One object per C++ type lives for ever, made by `type_of<T>()`. Flat values are copied as bytes;
/// deep ones hold sequences or strings.
struct Type {
  std::string name;
  Kind kind = Kind::structure;
  std::size_t size = 0;       // bytes
  std::size_t alignment = 1;  // bytes

  std::vector<TypeField> fields;                                  // structure
  const Type* element = nullptr;                                  // array, sequence
  std::size_t count = 0;                                          // array
  std::vector<std::pair<std::string, std::int64_t>> enumerators;  // enumeration
  std::vector<std::string> meanings;                              // of the enumerators, one each; empty: none to report

  void (*construct)(void* to) = nullptr;                     // default value into raw memory
  bool (*finite)(const void* value) = nullptr;               // no infinity, no NaN in it
  bool (*in_range)(const void* value) = nullptr;             // of all that it declares; null: it declares none
  std::uint64_t (*hash_words)(const void* value) = nullptr;  // the digest's sum over the value's words

  // deep values only
  void (*adopt)(void* value, std::pmr::memory_resource* memory) = nullptr;  // lives in that memory from now on
  void (*assign)(void* to, const void* from) = nullptr;  // deep copy into the memory of `to`; throws HeapExhausted
  void (*destroy)(void* value) = nullptr;

  // sequences, and strings as sequences of bytes
  std::size_t (*length)(const void* value) = nullptr;
  const void* (*elements)(const void* value) = nullptr;
  void* (*resize)(void* value, std::size_t length) = nullptr;  // returns the elements
  std::size_t (*capacity)(const void* value) = nullptr;        // of the room of its elements
  // its elements are those that lie there from now on; what it had is forgotten
  void (*lie_in)(void* value, std::pmr::memory_resource* memory, void* elements, std::size_t length,
                 std::size_t capacity) = nullptr;

  bool is_deep() const { return assign != nullptr; }
};

/// True if both have the same name, layout and fields; plugins bring their own objects for equal types.
bool same_type(const Type& a, const Type& b);

/// True if its bytes are those of doubles, one after the other, and there is at least one.
bool is_made_of_doubles(const Type& type);

/// True if anything in it may be an infinity or a NaN.
bool has_floating(const Type& type);

/// Deep copy of a value.
void copy_value(const Type& type, void* to, const void* from);

/// What fields() says of one member: its type is described when it is asked for.
struct DescribedField {
  std::string_view name, unit, text;
  FieldRange range;
  const Type& (*type)();
};

/// Adds the fields of the struct at `value`, with the addresses of its members in the same order. Apart from the
/// templates that describe types: there it would be compiled again for each of them.
void add_fields(Type& structure, std::span<const DescribedField> fields, const void* value, const void* const* members);

/// The field of that name, or null.
const TypeField* find_field(const Type& type, std::string_view name);

/// Integer of a value of kind boolean, *_integer, duration or enumeration, sign- or zero-extended to 64 bits.
std::int64_t read_integer(const Type& type, const void* value);
void write_integer(const Type& type, void* value, std::int64_t integer);

/// Bytes of a value of kind string.
std::string_view read_string(const Type& type, const void* value);
void write_string(const Type& type, void* value, std::string_view text);

/// Number of any value of which there are ranges, as these have it.
double read_ranged(const Type& type, const void* value);

/// Number of a value of kind floating.
double read_floating(const Type& type, const void* value);
void write_floating(const Type& type, void* value, double number);

}  // namespace jarol

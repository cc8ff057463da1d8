// Descriptions of plain structs: the one source that YAML binding, deep copy, trace, wire, help and digest read.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

namespace jarol {
namespace detail {

// What the compiler itself calls a member or a type; g++ 12 and clang 14 both end the name before one of "]);".
template <auto Member>
constexpr std::string_view pretty_member() {
  return __PRETTY_FUNCTION__;
}

template <class T>
constexpr std::string_view pretty_type() {
  return __PRETTY_FUNCTION__;
}

constexpr bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

// The last identifier of a text that ends in an identifier and closing punctuation.
constexpr std::string_view last_identifier(std::string_view text) {
  std::size_t end = text.size();
  while (end > 0 && !is_name_character(text[end - 1])) --end;
  std::size_t begin = end;
  while (begin > 0 && is_name_character(text[begin - 1])) --begin;
  return text.substr(begin, end - begin);
}

// The part of a pretty function name that holds "T = ..." or "Member = ...", without what follows it.
constexpr std::string_view argument_of(std::string_view pretty) {
  const std::size_t begin = pretty.find(" = ") + 3;
  std::size_t end = pretty.find(';', begin);
  if (end == std::string_view::npos) end = pretty.rfind(']');
  return pretty.substr(begin, end - begin);
}

template <class T>
struct MemberPointer;
template <class Owner_, class Value_>
struct MemberPointer<Value_ Owner_::*> {
  using Owner = Owner_;
  using Value = Value_;
};

}  // namespace detail

/// Name of a member as it is spelled in its struct.
template <auto Member>
constexpr std::string_view member_name() {
  return detail::last_identifier(detail::argument_of(detail::pretty_member<Member>()));
}

/// Name of a type as it is spelled at its definition, without namespaces or enclosing types.
template <class T>
constexpr std::string_view type_name() {
  return detail::last_identifier(detail::argument_of(detail::pretty_type<T>()));
}

/// One described member: its name is the compiler's, its unit and meaning are the author's.
template <auto Member>
struct Field {
  using Owner = typename detail::MemberPointer<decltype(Member)>::Owner;
  using Value = typename detail::MemberPointer<decltype(Member)>::Value;
  static constexpr auto pointer = Member;
  static constexpr std::string_view name = member_name<Member>();
  std::string_view unit;
  std::string_view text;
};

/// Describes one member; `unit` is an SI unit, "rad", or empty for a number without one.
template <auto Member>
constexpr Field<Member> field(std::string_view unit = "", std::string_view text = "") {
  return {unit, text};
}

/// The description of a struct: its fields in the order of their declaration.
template <class... F>
constexpr std::tuple<F...> describe(F... fields) {
  return {fields...};
}

/// An enumerator and its name, as `enumerators(Mode)` lists them. One that people have to be told about has a meaning,
/// as "there is water in the hull": a run's report tells when it goes out.
template <class E>
struct Enumerator {
  std::string_view name;
  E value;
  std::string_view meaning = "";
};

template <class T>
concept Described = requires {
  T::fields();
};

/// An enumeration is a value once `enumerators(E)`, found by its argument, returns an array of Enumerator<E>.
template <class E>
concept DescribedEnum = std::is_enum_v<E> && requires(E e) {
  enumerators(e);
};

namespace detail {

struct Anything {
  template <class T>
  operator T() const;
};

template <class T, std::size_t... I>
constexpr bool takes(std::index_sequence<I...>) {
  return requires { T{(static_cast<void>(I), Anything{})...}; };
}

// How many members an aggregate has: the longest list of initializers that it takes.
template <class T, std::size_t N = 0>
constexpr std::size_t member_count() {
  if constexpr (takes<T>(std::make_index_sequence<N + 1>{})) {
    return member_count<T, N + 1>();
  } else {
    return N;
  }
}

template <class T>
constexpr bool each_field_owned_and_in_order() {
  return std::apply([](auto... f) { return (std::is_same_v<typename decltype(f)::Owner, T> && ...); }, T::fields());
}

}  // namespace detail
}  // namespace jarol

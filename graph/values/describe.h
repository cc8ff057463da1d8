// Descriptions of plain structs: the one source that YAML binding, deep copy, trace, wire, help and digest read.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include "graph/values/members.h"
#include "graph/values/ranged.h"
#include "graph/values/substitutes.h"

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

/// One described member: its name is the compiler's, its unit, meaning and range are the author's.
template <auto Member>
struct Field {
  using Owner = typename detail::MemberPointer<decltype(Member)>::Owner;
  using Value = typename detail::MemberPointer<decltype(Member)>::Value;
  static constexpr auto pointer = Member;
  static constexpr std::string_view name = member_name<Member>();
  std::string_view unit;
  std::string_view text;
  FieldRange range{};

  /// With both ends; of arrays and sequences each element. A parameter or `init` outside is an error with its place, an
  /// output outside a fault. Of integers and durations whole numbers up to 2^53.
  consteval Field in(detail::BoundOf<Value> min, detail::BoundOf<Value> max) const {
    return {unit, text, detail::range_of<Value>(min, max)};
  }
};

namespace detail {

template <auto Member, class T = typename Field<Member>::Value>
constexpr void require_value() {
  static_assert(!is_pointer<T>,
                "a value owns what it holds: copy what a pointer leads to into the struct, or keep an index");
  static_assert(!is_vector<T>,
                "a value lies in its task's heap: use jarol::Sequence<T> or std::array in place of std::vector");
  static_assert(!is_text<T>, "a value lies in its task's heap: use jarol::String in place of std::string");
  static_assert(!is_choice<T>,
                "a value has one form: use a bool beside a member in place of std::optional or std::variant");
}

#if defined(__clang__)
// no place within a value can be an argument of a template here, so that the member's number stands for it
#define JAROL_MEMBER(T, I) I
#else
#define JAROL_MEMBER(T, I) detail::address_of_member<T, I>()
#endif

template <auto...>
inline constexpr bool never = false;

template <auto Member>
constexpr void reject_missing() {
  static_assert(never<Member>, "fields() must describe every member of the struct; it lacks 'Member'");
}
template <auto Member, auto Field>
constexpr void reject_order() {
  static_assert(never<Member, Field>,
                "fields() must describe the members in their order; 'Member' comes before 'Field'");
}
template <auto Field>
constexpr void reject_surplus() {
  static_assert(never<Field>, "fields() must describe each member once; 'Field' is there twice");
}

template <auto First, auto...>
struct OwnerOf {
  using Type = typename MemberPointer<decltype(First)>::Owner;
};

}  // namespace detail

/// Describes one member; `unit` is an SI unit, "rad", or empty for a number without one.
template <auto Member>
constexpr Field<Member> field(std::string_view unit = "", std::string_view text = "") {
  detail::require_value<Member>();
  return {unit, text, {}};
}

/// The description of a struct: its fields in the order of their declaration. One that is missing, twice or misplaced
/// does not compile, and the compiler's lines name it.
template <auto... Member>
constexpr std::tuple<Field<Member>...> describe(Field<Member>... fields) {
  if constexpr (sizeof...(Member) > 0) {
    using T = typename detail::OwnerOf<Member...>::Type;
    static_assert((std::is_same_v<typename Field<Member>::Owner, T> && ...),
                  "fields() may describe members of its own struct only");
    constexpr std::size_t wrong = detail::first_difference<T, Member...>();
    if constexpr (wrong < detail::member_count<T>()) {
      constexpr auto field = detail::element<wrong, Member..., nullptr>();
      if constexpr (wrong == sizeof...(Member)) {
        detail::reject_missing<JAROL_MEMBER(T, wrong)>();
      } else {
        detail::reject_order<JAROL_MEMBER(T, wrong), field>();
      }
    } else if constexpr (wrong < sizeof...(Member)) {
      detail::reject_surplus<detail::element<wrong, Member...>()>();
    }
  }
  return {fields...};
}
#undef JAROL_MEMBER

/// An enumerator and its name, as `enumerators(Mode)` lists them. One that people have to be told about has a meaning,
/// as "there is water in the hull": a run's report says when it goes out.
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

}  // namespace jarol

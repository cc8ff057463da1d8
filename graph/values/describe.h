// Descriptions of plain structs: the one source that YAML binding, deep copy, trace, wire, help and digest read.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <type_traits>
#include <utility>

#include "graph/values/elements.h"
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

// Is it one, down to the elements of its arrays and sequences, but for the names of enumerations?
template <class T, class Part = Innermost<T>>
inline constexpr bool is_value = (Described<Part> || std::is_enum_v<Part> || std::is_arithmetic_v<Part> ||
                                  std::same_as<Part, Duration> || std::same_as<Part, String>)&&!has_substitute<Part>;

// Names may come behind the struct that has the enumeration. clang looks for them where a field() stands, and finds
// none ever after: there type_of.h asks, with more lines around it.
#if defined(__clang__)
inline constexpr bool asks_for_names_at_once = false;
#else
inline constexpr bool asks_for_names_at_once = true;
#endif

// What stands around a value in a distributer's channel.
template <class T>
inline constexpr bool holds_value = !is_value<T> && requires {
  typename T::Value;
};

}  // namespace detail

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
    if constexpr (detail::is_value<Value>) return {unit, text, detail::range_of<Value>(min, max)};
    return *this;  // it has been rejected
  }
};

namespace detail {

template <auto Member, class T = Innermost<typename Field<Member>::Value>>
constexpr void require_value() {
  static_assert(!is_pointer<T>,
                "a value owns what it holds: copy what a pointer leads to into the struct, or keep an index");
  static_assert(!is_container<T>,
                "a value lies in its task's heap: use jarol::Sequence<T> or std::array in place of std::vector");
  static_assert(!is_text<T>, "a value lies in its task's heap: use jarol::String in place of std::string");
  static_assert(!is_choice<T>,
                "a value has one form: use a bool beside a member in place of std::optional or std::variant");
  static_assert(!std::is_array_v<T>, "a value is copied whole: use std::array in place of T[N]");
  static_assert(!is_matrix<T>, "of Eigen a value holds columns of fixed size: use std::array or jarol::Sequence<T>");
  static_assert(!is_odd_number<T>,
                "a number is of one size everywhere: use std::int8_t to std::uint64_t for characters and __int128, "
                "double for long double");
  static_assert(!is_other_duration<T>,
                "a duration is in nanoseconds: use std::chrono::nanoseconds, to which the others convert");
  static_assert(is_value<T> || has_substitute<T>, "a struct within a value needs a fields() of its own");
  if constexpr (asks_for_names_at_once)
    static_assert(!std::is_enum_v<T> || DescribedEnum<T>, "an enumeration within a value needs enumerators(E)");
}

#if defined(__clang__)
// no place within a value can be an argument of a template here, so that the member's number stands for it
#define JAROL_MEMBER(T, I) I
#define JAROL_HOW_NAMED ", counted from 0"
#else
#define JAROL_MEMBER(T, I) detail::address_of_member<T, I>()
#define JAROL_HOW_NAMED ""
#endif

// Named so that the compiler's lines around an assertion read well: "describes<&Value::depth> evaluates to false".
template <auto Member>
inline constexpr bool describes = false;
template <auto Member, auto Described>
inline constexpr bool describes_in_order = false;
template <auto Member>
inline constexpr bool describes_once = false;

// The first that stands in the list before; the length of the list if none does.
template <auto... Member>
constexpr std::size_t first_repeated() {
  std::size_t first = sizeof...(Member), i = 0;
  const auto look = [&]<auto One>(Field<One>*) {
    std::size_t before = 0, j = 0;
    ((before += j++ < i && std::is_same_v<Field<Member>, Field<One>> ? 1 : 0), ...);
    if (before > 0 && first == sizeof...(Member)) first = i;
    ++i;
  };
  (look(static_cast<Field<Member>*>(nullptr)), ...);
  return first;
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

namespace detail {

// By its place, as one may be there twice, which is an error that is to be said alone.
template <std::size_t I, auto Member>
struct PlacedField : Field<Member> {};
template <class Places, auto... Member>
struct PlacedFields;
template <std::size_t... I, auto... Member>
struct PlacedFields<std::index_sequence<I...>, Member...> : PlacedField<I, Member>... {};

}  // namespace detail

/// Fields of one struct. In place of a std::tuple, which takes longer to compile than all that is done with it.
template <auto... Member>
struct FieldList : detail::PlacedFields<std::make_index_sequence<sizeof...(Member)>, Member...> {
  static constexpr std::size_t count = sizeof...(Member);
};

/// Calls function(field...) with all of a list.
template <std::size_t... I, auto... Member, class Function>
constexpr decltype(auto) with_fields(
    [[maybe_unused]] const detail::PlacedFields<std::index_sequence<I...>, Member...>& fields, Function&& function) {
  return function(static_cast<const Field<Member>&>(static_cast<const detail::PlacedField<I, Member>&>(fields))...);
}

/// A null pointer to the type of a struct's fields: for what reads their types and not what is said of them.
template <class T>
inline constexpr std::remove_cvref_t<decltype(T::fields())>* field_types = nullptr;

/// Calls function(value.*Member...) with all members that the value's struct describes.
template <class T, class Function>
constexpr decltype(auto) with_described(T& value, Function&& function) {
  return [&]<auto... Member>(FieldList<Member...>*)->decltype(auto) { return function(value.*Member...); }
  (field_types<std::remove_const_t<T>>);
}

/// The description of a struct: its fields in the order of their declaration. One that is missing, twice or misplaced
/// does not compile, and the compiler's lines name it.
template <auto... Member>
constexpr FieldList<Member...> describe(Field<Member>... fields) {
  if constexpr (sizeof...(Member) > 0) {
    using T = typename detail::OwnerOf<Member...>::Type;
    static_assert((std::is_same_v<typename Field<Member>::Owner, T> && ...),
                  "fields() may describe members of its own struct only");
    // what has been rejected as no value has no members to be compared
    if constexpr (((detail::is_value<typename Field<Member>::Value> ||
                    detail::holds_value<typename Field<Member>::Value>)&&...)) {
      constexpr std::size_t repeated = detail::first_repeated<Member...>();
      constexpr std::size_t wrong = detail::first_difference<T, Member...>();
      if constexpr (repeated < sizeof...(Member)) {
        static_assert(detail::describes_once<detail::element<repeated, Member...>()>,
                      "fields() must describe each member once; this one is there twice");
      } else if constexpr (detail::is_described<T, wrong, Member...>()) {
        static_assert(detail::describes_in_order<JAROL_MEMBER(T, wrong), detail::element<wrong, Member...>()>,
                      "fields() must describe the members in their order; the first of these belongs before the "
                      "second" JAROL_HOW_NAMED);
      } else if constexpr (wrong < detail::member_count<T>()) {
        static_assert(detail::describes<JAROL_MEMBER(T, wrong)>,
                      "fields() must describe every member of the struct; it lacks this one" JAROL_HOW_NAMED);
      }
    }
  }
  return {{{fields}...}};
}

#undef JAROL_MEMBER
#undef JAROL_HOW_NAMED

/// An enumerator and its name, as `enumerators(Mode)` lists them. One that people have to be told about has a meaning,
/// as "there is water in the hull": a run's report says when it goes out.
template <class E>
struct Enumerator {
  std::string_view name;
  E value;
  std::string_view meaning = "";
};

}  // namespace jarol

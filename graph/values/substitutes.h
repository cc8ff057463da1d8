// What can't be a member of a value, and what takes its place.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

#include "graph/values/elements.h"

namespace jarol::detail {

template <class T, template <class...> class Template>
struct IsA : std::false_type {};
template <template <class...> class Template, class... A>
struct IsA<Template<A...>, Template> : std::true_type {};

template <class T>
inline constexpr bool is_pointer =
    std::is_pointer_v<T> || std::is_member_pointer_v<T> || IsA<T, std::unique_ptr>::value ||
    IsA<T, std::shared_ptr>::value || IsA<T, std::weak_ptr>::value;
template <class T>
inline constexpr bool is_text = IsA<T, std::basic_string>::value || IsA<T, std::basic_string_view>::value;
template <class T>
inline constexpr bool is_matrix = std::is_base_of_v<Eigen::EigenBase<T>, T>;
// of the standard library: vectors, maps, spans
template <class T>
inline constexpr bool is_container = !is_text<T> && !is_matrix<T> && requires(T & t) {
  typename T::value_type;
  t.begin();
};
template <class T>
inline constexpr bool is_odd_number = Character<T> || Integer128<T> || std::same_as<T, long double>;
template <class T>
inline constexpr bool is_other_duration = IsA<T, std::chrono::duration>::value && !std::same_as<T, Duration>;
template <class T>
inline constexpr bool is_choice = IsA<T, std::optional>::value || IsA<T, std::variant>::value;

template <class T>
inline constexpr bool has_substitute = is_pointer<T> || is_text<T> || is_matrix<T> || is_container<T> || is_choice<T> ||
                                       is_odd_number<T> || is_other_duration<T> || std::is_array_v<T>;

}  // namespace jarol::detail

// What values are made of: which of them change their size.
#pragma once

#include "graph/values/describe.h"

namespace jarol::detail {

// Does it hold anything of changing size?
template <class T>
constexpr bool is_deep() {
  if constexpr (SequenceOf<T> || std::same_as<T, String>) {
    return true;
  } else if constexpr (Array<T>) {
    return is_deep<typename ArrayTraits<T>::Element>();
  } else if constexpr (Described<T>) {
    return []<auto... Member>(FieldList<Member...>*) { return (is_deep<typename Field<Member>::Value>() || ...); }
    (field_types<T>);
  } else {
    return false;
  }
}

}  // namespace jarol::detail

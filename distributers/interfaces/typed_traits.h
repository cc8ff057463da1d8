// What a distributer of its own type has: its structs, what each entry of its handlers is for, and its hooks.
#pragma once

#include <type_traits>
#include <utility>

#include "distributers/interfaces/any_distributer.h"
#include "distributers/interfaces/distributer.h"

namespace jarol::distributers {
namespace detail {

template <class D>
concept WithParameters = requires {
  typename D::Param;
};

struct NoParameters {
  static constexpr auto fields() { return describe(); }
};
template <class D>
auto parameters_of() {
  if constexpr (WithParameters<D>)
    return typename D::Param{};
  else
    return NoParameters{};
}
template <class D>
auto in_of() {
  if constexpr (requires { typename D::In; })
    return typename D::In{};
  else
    return NoParameters{};
}
template <class D>
auto out_of() {
  if constexpr (requires { typename D::Out; })
    return typename D::Out{};
  else
    return NoParameters{};
}

template <class T>
inline constexpr bool is_newest = false;
template <class T>
inline constexpr bool is_newest<Newest<T>> = true;
template <class T>
inline constexpr bool is_computed = false;
template <class T>
inline constexpr bool is_computed<Computed<T>> = true;

enum class EntryKind { on, send, compute };
template <class E>
struct EntryOf;
template <class M, class F>
struct EntryOf<On<M, F>> {
  static constexpr EntryKind kind = EntryKind::on;
};
template <auto Channel, class F>
struct EntryOf<Send<Channel, F>> {
  static constexpr EntryKind kind = EntryKind::send;
};
template <auto Channel, class F>
struct EntryOf<Compute<Channel, F>> {
  static constexpr EntryKind kind = EntryKind::compute;
};

// The places of members, as template arguments of one function: true if they are the same member.
template <auto A, auto B>
constexpr bool same_member() {
  if constexpr (std::is_same_v<decltype(A), decltype(B)>)
    return A == B;
  else
    return false;
}

// A member that has that name and can't be called as it would be: a mistake, not a member of its own.
#define JAROL_HOOK(name, arguments, call)                                                            \
  template <class D>                                                                                 \
  inline constexpr bool has_##name = [] {                                                            \
    constexpr bool fits = requires(D & d) { call; };                                                 \
    static_assert(                                                                                   \
        fits || !requires { &D::name; }, "a distributer's " #name " is called as " #name arguments); \
    return fits;                                                                                     \
  }();
JAROL_HOOK(peer_changed, "()", d.peer_changed())
JAROL_HOOK(any_message, "(const messages::MessageRef& message)",
           d.any_message(std::declval<const messages::MessageRef&>()))
JAROL_HOOK(take_over, "()", d.take_over())
JAROL_HOOK(ending, "()", d.ending())
JAROL_HOOK(overrides_end, "() const", static_cast<bool>(std::as_const(d).overrides_end()))
JAROL_HOOK(steers_itself, "() const", static_cast<bool>(std::as_const(d).steers_itself()))
JAROL_HOOK(finish, "()", d.finish())
JAROL_HOOK(non_finite_inputs, "()", static_cast<std::uint64_t>(d.non_finite_inputs()))
JAROL_HOOK(listen_at, "(const std::string& address)", d.listen_at(std::declval<const std::string&>()))
JAROL_HOOK(reach, "(Duration instant, messages::Receiver& system)",
           d.reach(Duration{}, std::declval<messages::Receiver&>()))
JAROL_HOOK(serialize, "(Archive& archive)", d.serialize(std::declval<Archive&>()))
JAROL_HOOK(announce, "(Duration instant, messages::Receiver& all)",
           d.announce(Duration{}, std::declval<messages::Receiver&>()))
#undef JAROL_HOOK

}  // namespace detail

}  // namespace jarol::distributers

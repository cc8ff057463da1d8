// The form of a distributer, as task.h has that of a task: a plain class between the messages of an external system and
// the values of the core.
//
//   class Sonde {
//    public:
//     static constexpr std::string_view summary = "a probe, over IMC";
//     static constexpr bool is_vehicle = true;          // else an operator
//     struct Param { ... };                             // described; left out: it has none
//     struct In {                                       // channels that bring values into the graph
//       Newest<double> depth;                           // brought by messages
//       static constexpr auto fields() { return describe(channel<&In::depth>("below the surface")); }
//     };
//     struct Out {                                      // channels that take values to the outside
//       Lamp lamp;
//       static constexpr auto fields() { return describe(channel<&Out::lamp>("whether it shines")); }
//     };
//     static const messages::MessageSet& message_set() { return imc::message_set(); }
//     static constexpr auto handlers() {
//       return handle(on<imc::Depth>(&Sonde::depth), send<&Out::lamp>(&Sonde::shine));
//     }
//     explicit Sonde(const Param&);                     // where it has any
//     In in;
//
//     void depth(const imc::Depth& message) { in.depth = message.value; }
//     void shine(const Lamp& lamp, messages::Receiver& system);
//   };
//
// It may have further members, each called at its time, see any_distributer.h: reach(Duration, messages::Receiver&),
// announce(Duration, messages::Receiver&), any_message(const messages::MessageRef&), peer_changed(),
// listen_at(const std::string&), ending(), overrides_end() const, steers_itself() const, finish(), take_over(),
// non_finite_inputs() const; and serialize(Archive&), which gives the archive all that changes while a run goes on
// beside `in`: without it a run can be saved only where there is nothing of that sort.
#pragma once

#include <concepts>
#include <functional>
#include <string_view>
#include <tuple>

#include "distributers/messages/message.h"
#include "graph/values/archive.h"
#include "graph/values/describe.h"

namespace jarol::distributers {

/// An `in` channel: the newest value that messages brought. To write it makes it new, and what is new is taken once.
template <class T>
struct Newest {
  using Value = T;

  Newest() = default;
  Newest& operator=(const T& brought) {
    renew() = brought;
    return *this;
  }
  /// For a change of a part.
  T& renew() {
    is_new = true;
    return value;
  }
  const T& operator*() const { return value; }
  const T* operator->() const { return &value; }
  void serialize(Archive& archive) {
    archive(is_new);
    archive.value(type_of<T>(), &value);
  }

  T value{};
  bool is_new = false;  // and not taken yet
};

/// An `in` channel whose value is computed whenever it is taken, by a `compute<&In::channel>(...)`.
template <class T>
struct Computed {
  using Value = T;
  void serialize(Archive&) {}
};

/// Describes a channel: a member of In or Out.
template <auto Member>
constexpr Field<Member> channel(std::string_view text) {
  using Value = typename Field<Member>::Value;
  if constexpr (jarol::detail::holds_value<Value>)
    jarol::detail::require_value<Member, jarol::detail::Innermost<typename Value::Value>>();
  else
    jarol::detail::require_value<Member>();
  return {"", text, {}};
}

/// A message of a message set, as imc::Depth.
template <class M>
concept SomeMessage = requires {
  { M::message_id } -> std::convertible_to<std::uint32_t>;
  { &M::descriptor } -> std::same_as<const messages::MessageDescriptor*>;
};

template <class M, class F>
struct On {
  using Message = M;
  F handler;
};

/// Each M that arrives is given to the handler: a member function, or called with the distributer and the message; and
/// with the MessageRef after it where it takes that, for the header of its packet.
template <class M, class F>
constexpr On<M, F> on(F handler) {
  static_assert(SomeMessage<M>, "on<M>(...): M is a message of a message set, as messages::imc::Depth");
  return {handler};
}

template <auto Channel, class F>
struct Send {
  static constexpr auto channel = Channel;
  F handler;
};

/// A value of that `out` channel is given to the handler, with what takes the messages that it makes of it.
template <auto Channel, class F>
constexpr Send<Channel, F> send(F handler) {
  return {handler};
}

template <auto Channel, class F>
struct Compute {
  static constexpr auto channel = Channel;
  F handler;
};

/// The handler gives the value of that Computed channel when it is taken.
template <auto Channel, class F>
constexpr Compute<Channel, F> compute(F handler) {
  return {handler};
}

/// What a distributer does with messages and channels; a message and a channel has one handler.
template <class... Entry>
constexpr std::tuple<Entry...> handle(Entry... entries) {
  return {entries...};
}

}  // namespace jarol::distributers

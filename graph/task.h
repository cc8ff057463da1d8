// The form of a task and the class that the runtime makes of it.
#pragma once

#include <algorithm>
#include <cstring>
#include <exception>
#include <memory>
#include <string>
#include <typeinfo>

#include "graph/floating_point.h"
#include "graph/values/type_of.h"

namespace jarol {

/// What a task sees of time: the instant of its release, always the same however late it really runs.
struct Tick {
  Duration now{};               // logical time since the start
  std::int64_t activation = 0;  // 0, 1, 2 ...
  Duration period{};
};

/// How an activation ended; `left_out`: it never ran, as one before it was faulty; `overrun`: as one before it still
/// ran.
enum class Outcome : std::uint8_t { good, threw, heap_exhausted, non_finite, left_out, late, overrun, out_of_range };

/// First characters of what a task threw.
struct FaultText {
  char text[120] = "";
};

/// Keeps the text from its place `from` on, as much as there is room for.
inline void keep_text(FaultText& fault, std::string_view text, std::size_t from = 0) {
  const std::size_t size = std::min(text.size(), sizeof fault.text - 1 - from);
  std::memcpy(fault.text + from, text.data(), size);
  fault.text[from + size] = '\0';
}

/// Of what was thrown: the floating-point environment is as it was, `fault` has the text.
[[gnu::noinline]] inline Outcome keep_threw(FaultText& fault, const char* what) {
  restore_floating_point();
  constexpr std::string_view threw = "threw: ";
  keep_text(fault, threw);
  keep_text(fault, what, threw.size());
  return Outcome::threw;
}
[[gnu::noinline]] inline Outcome keep_threw(FaultText& fault, const std::exception& error) {
  if (typeid(error) != typeid(HeapExhausted)) return keep_threw(fault, error.what());  // faster than another handler
  restore_floating_point();
  keep_text(fault, error.what());
  return Outcome::heap_exhausted;
}

/// Calls what runs tasks, and keeps what it throws in the text that `fault_text` names then.
template <class Run, class Text>
Outcome contain(Run&& run, Text&& fault_text) {
  try {
    try {
      run();
      return Outcome::good;
    } catch (const std::exception& error) { return keep_threw(fault_text(), error); } catch (...) {
      return keep_threw(fault_text(), "something that is not a std::exception");
    }
  } catch (...) { return keep_threw(fault_text(), "something whose destructor threw"); }
}

/// Where one task's values lie.
struct TaskMemory {
  const void* parameters = nullptr;
  const void* in = nullptr;
  void* state = nullptr;
  void* out = nullptr;
  FaultText* fault = nullptr;
};

/// Runs an activation, contains what it throws and looks whether its outputs are finite and in their ranges.
using Thunk = Outcome (*)(const TaskMemory& memory, const Tick& tick);

/// Runs an activation, and nothing else.
using Body = void (*)(const TaskMemory& memory, const Tick& tick);

/// What becomes of a task's four structs outside its `run`, each at a place of its own: they are made, copied and
/// ended. Nothing calls it; isolation looks at what it reaches.
using Handling = void (*)(void* const* places);

/// A task type: its inputs are the fields of `in`, its outputs those of `out`.
struct TaskClass {
  std::string name;
  std::string summary;
  const Type* parameters = nullptr;
  const Type* in = nullptr;
  const Type* state = nullptr;
  const Type* out = nullptr;
  Thunk run = nullptr;
  Body body = nullptr;

  /// The same without a look at the floating-point environment afterwards: for tasks whose machine code can't change
  /// it (graph/plugins/machine_code.h).
  struct Unchecked {
    Thunk run = nullptr;
    Body body = nullptr;
  } unchecked{};
  Handling handling = nullptr;
  void trust_floating_point() {
    run = unchecked.run;
    body = unchecked.body;
  }

  /// Has values of changing size, which need a heap.
  bool is_deep() const { return in->is_deep() || state->is_deep() || out->is_deep(); }
};

namespace detail {

// Stands for each of the four structs that a task leaves out.
struct None {
  static constexpr auto fields() { return describe(); }
};

template <class T>
auto parameters_of() {
  if constexpr (requires { typename T::Param; })
    return typename T::Param{};
  else
    return None{};
}
template <class T>
auto in_of() {
  if constexpr (requires { typename T::In; })
    return typename T::In{};
  else
    return None{};
}
template <class T>
auto state_of() {
  if constexpr (requires { typename T::State; })
    return typename T::State{};
  else
    return None{};
}
template <class T>
auto out_of() {
  if constexpr (requires { typename T::Out; })
    return typename T::Out{};
  else
    return None{};
}

// A tuple of one reference, or of none where the task has no such struct.
template <class V, class Pointer>
auto present(Pointer* pointer) {
  if constexpr (std::is_same_v<std::remove_const_t<V>, None>) {
    return std::tuple<>{};
  } else {
    return std::tuple<V&>(*static_cast<V*>(pointer));
  }
}

// What `run` takes: references to the tick and to those of the four structs that the task has.
template <class T>
auto arguments_of(const TaskMemory& memory, const Tick& tick) {
  return std::tuple_cat(present<const decltype(parameters_of<T>())>(memory.parameters), std::tuple<const Tick&>(tick),
                        present<const decltype(in_of<T>())>(memory.in), present<decltype(state_of<T>())>(memory.state),
                        present<decltype(out_of<T>())>(memory.out));
}

template <class T, class... Arguments>
constexpr bool runs_on(std::type_identity<std::tuple<Arguments...>>) {
  return requires { requires std::is_convertible_v<decltype(&T::run), void (*)(Arguments...)>; };
}

// With a state or an output by value it could be called, too, and what it does to them would be lost.
template <class T>
constexpr bool has_run() {
  return runs_on<T>(std::type_identity<decltype(arguments_of<T>({}, {}))>());
}

template <class T>
constexpr bool has_summary() {
  return requires { std::string_view(T::summary); };
}

// The task gets a tick of its own: one that it changes in spite of `const` reaches no other.
template <class T, bool Checked>
inline void call(const TaskMemory& memory, const Tick& tick) {
  const Tick own = tick;
  std::apply(T::run, arguments_of<T>(memory, own));
  if constexpr (Checked) require_default_floating_point();
}

template <class T, bool Checked>
Outcome thunk(const TaskMemory& memory, const Tick& tick) {
  using Out = decltype(out_of<T>());
  const Outcome outcome =
      contain([&] { call<T, Checked>(memory, tick); }, [&]() -> FaultText& { return *memory.fault; });
  if (outcome != Outcome::good) return outcome;
  const Out& out = *static_cast<const Out*>(memory.out);
  if (has_non_finite(out)) return Outcome::non_finite;
  return is_in_range(out) ? Outcome::good : Outcome::out_of_range;
}

// A sequence that gets longer makes its elements by their default values.
template <class V>
void lengthen(V& value) {
  if constexpr (SequenceOf<V>) {
    value.resize(value.size() + 1);
    lengthen(value[0]);
  } else if constexpr (Array<V>) {
    lengthen(value[0]);
  } else if constexpr (Described<V>) {
    with_described(value, [](auto&... member) { (lengthen(member), ...); });
  }
}

template <class V>
void* const* handle_value(void* const* places) {
  [[maybe_unused]] V* const made = new (*places++) V{};
  if constexpr (is_deep<V>()) {
    lengthen(*made);
    *static_cast<V*>(places[0]) = *static_cast<const V*>(places[1]);
    std::destroy_at(static_cast<V*>(places[2]));
    places += 3;
  }
  return places;
}

template <class T>
void handle_values(void* const* places) {
  places = handle_value<decltype(parameters_of<T>())>(places);
  places = handle_value<decltype(in_of<T>())>(places);
  places = handle_value<decltype(state_of<T>())>(places);
  handle_value<decltype(out_of<T>())>(places);
}

}  // namespace detail

/// The class of a task form: an empty struct with `summary`, any of Param, In, State, Out, and
/// `static void run(const Param&, const Tick&, const In&, State&, Out&)` without the structs that it leaves out.
template <class T>
TaskClass task_class() {
  static_assert(std::is_empty_v<T>, "a task is an empty struct; what it keeps belongs into its State");
  static_assert(detail::has_summary<T>(),
                "a task says what it does: static constexpr std::string_view summary = \"smooths its input\";");
  static_assert(
      detail::has_run<T>(),
      "a task has a public static void run(const Param&, const Tick&, const In&, State&, Out&), without those "
      "of the four structs that it does not have");
  if constexpr (detail::has_summary<T>() && detail::has_run<T>())
    return {std::string(type_name<T>()),
            std::string(T::summary),
            &type_of<decltype(detail::parameters_of<T>())>(),
            &type_of<decltype(detail::in_of<T>())>(),
            &type_of<decltype(detail::state_of<T>())>(),
            &type_of<decltype(detail::out_of<T>())>(),
            &detail::thunk<T, true>,
            &detail::call<T, true>,
            {&detail::thunk<T, false>, &detail::call<T, false>},
            &detail::handle_values<T>};
  else
    return {};
}

/// The same for a task whose machine code can't change the floating-point environment.
template <class T>
TaskClass trusted_task_class() {
  TaskClass made = task_class<T>();
  made.trust_floating_point();
  return made;
}

}  // namespace jarol

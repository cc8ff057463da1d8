// What registers and the stack of a function hold, as far as that decides what it may reach, and what each instruction
// makes of it.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>

#include "graph/isolation/instruction.h"
#include "graph/isolation/object.h"

namespace jarol::isolation {

/// Where a value comes from, as far as that decides what a call through it may reach.
struct Origin {
  enum class Kind : std::uint8_t {
    nothing,  // no path was followed that computes it
    any,      // unknown, or of several origins
    number,   // `at`
    address,  // of code or data in the object, `at`
    element,  // an address within constant data, by an index that is not known; `at`: where the table begins
    table,    // loaded from there; `at`: where the table begins
    task,     // read from the memory of the task, its values and what they hold, or computed with that
    library,  // returned by a function outside
    frame,    // an address on the stack, `at` bytes from where the function began
    own,      // one of several of the two kinds `address` and `frame`
    spot,     // an address on the stack, by an index of the task; `at`: where it counts from
  };
  Kind kind = Kind::nothing;
  std::int64_t at = 0;
  std::int64_t loaded = -1;  // the displacement of the load that it comes from
  int depth = 0;             // of what is the task's: how many loads lead there from TaskMemory

  friend bool operator==(const Origin&, const Origin&) = default;
};

/// Of both paths that meet.
Origin join(const Origin& a, const Origin& b);

inline constexpr Origin unknown{Origin::Kind::any, 0, -1};
/// Of a task; see Origin::depth.
Origin of_task(int depth);

/// What registers and the stack hold, and which vectors nothing but `own` addresses; slots of the stack that are
/// missing are unknown.
struct State {
  std::array<Origin, 16> registers{};
  std::uint32_t own_vectors = 0;  // a bit each
  std::map<std::int64_t, Origin> stack;
};

/// Joins into `a`; true: it changed.
bool join_into(State& a, const State& b);

/// The instructions of an object.
class Values {
 public:
  explicit Values(const Object& object) : object_(object) {}

  Origin value_of(const Instruction& instruction, const Operand& operand, const State& state) const;
  /// Where an operand in memory lies, as far as that is in the object and known; none: it isn't, or it is the address
  /// alone that is taken of what registers lead to, as of the end of an array.
  std::optional<Address> known_address(const Instruction& instruction, const Operand& operand,
                                       const State& state) const;
  /// What the instruction makes of the state; calls and jumps apart.
  void apply(const Instruction& instruction, State& state) const;
  /// A call that returns; `thrown` is joined with what holds where its exception is caught.
  void call(const Instruction& instruction, State& state, State& thrown) const;

 private:
  Origin loaded_from(Address at) const;
  Origin address_of(const Instruction& instruction, const Operand& operand, const State& state) const;
  void store(const Instruction& instruction, const Operand& to, const Origin& value, State& state) const;
  bool is_import(const Instruction& call, const State& state) const;
  Origin element_of(const Origin& table, std::int64_t displacement) const;
  bool gathers_own(const Instruction& instruction, const State& state) const;

  const Object& object_;
};

}  // namespace jarol::isolation

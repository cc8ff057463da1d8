// A function's machine code, decoded as far as its isolation depends on it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "graph/isolation/object.h"

namespace jarol::isolation {

/// A general register, 0 to 15; whatever its width.
using Register = std::int8_t;
inline constexpr Register no_register = -1, instruction_pointer = -2;
inline constexpr Register rax = 0, rcx = 1, rdx = 2, rbx = 3, rsp = 4, rbp = 5, rsi = 6, rdi = 7, r8 = 8, r9 = 9;

struct Operand {
  enum class Kind : std::uint8_t { none, reg, number, memory, vector, other };
  Kind kind = Kind::none;
  bool read = false;
  bool written = false;
  bool thread_local_data = false;  // relative to fs or gs, but for the next
  bool reads_guard = false;        // the stack protector's number
  std::uint8_t size = 0;           // bytes
  std::uint8_t scale = 1;          // of the index
  Register reg = no_register;      // of memory: the base; of vectors: 0 to 31, whatever their width
  Register index = no_register;
  std::int64_t number = 0;  // of memory: the displacement
};

struct Instruction {
  enum class Form : std::uint8_t { move, address, add, push, pop, call, jump, branch, leave, end, other };
  Address at = 0, next = 0;
  Form form = Form::other;
  std::array<Operand, 5> operands{};
  std::uint16_t writes = 0;    // general registers, a bit each
  bool subtracts = false;      // `add` has a sign
  bool clears = false;         // its first operand, by xor
  bool gathers = false;        // puts its operands beside each other in a vector, or copies one
  bool x87 = false;            // computes with the registers of long double
  const char* forbidden = "";  // why no task may hold it
  std::string text{};          // of one that is forbidden: "rdtsc"
  /// The address that a memory operand relative to the instruction pointer names.
  Address place(const Operand& operand) const { return next + static_cast<Address>(operand.number); }
};

/// In order of address, up to the first bytes that are no instruction; these are not in it.
std::vector<Instruction> decode(const Object& object, Address begin, Address end);
/// Of a whole section, by places within it, with the zeros that linkers lay between functions left out; none: some of
/// it is no instruction.
std::optional<std::vector<Instruction>> decode_section(Bytes code);

/// As g++ begins a function that is protected, also one that never returns and so never looks:
/// mov %fs:0x28, r; mov r, n(%rsp); xor r, r.
bool puts_guard_aside(const std::vector<Instruction>& code, const Instruction& first);

}  // namespace jarol::isolation

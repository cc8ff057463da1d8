#include "graph/isolation/values.h"

#include <algorithm>
#include <utility>

namespace jarol::isolation {
namespace {

using Kind = Origin::Kind;
using Form = Instruction::Form;

Origin address(Address at) { return {Kind::address, static_cast<std::int64_t>(at), -1}; }
Origin number(std::int64_t value) { return {Kind::number, value, -1}; }
Origin spot(std::int64_t begin) { return {Kind::spot, begin, -1}; }

bool is_own(const Origin& origin) {
  return origin.kind == Kind::address || origin.kind == Kind::frame || origin.kind == Kind::own;
}

// Of what is computed with the task's values.
int depth_of(const Origin& a, const Origin& b) {
  if (a.kind != Kind::task) return b.depth;
  return b.kind != Kind::task ? a.depth : std::min(a.depth, b.depth);
}

Origin sum(const Origin& a, const Origin& b, bool subtracts) {
  for (const auto& [base, index] : {std::pair(a, b), std::pair(b, a)}) {
    if (base.kind == Kind::frame && index.kind == Kind::task && !subtracts) return spot(base.at);
    if (base.kind == Kind::spot && index.kind == Kind::number && !subtracts) return spot(base.at + index.at);
  }
  if (a.kind == Kind::task || b.kind == Kind::task) return of_task(depth_of(a, b));
  if (a.kind == Kind::element && b.kind == Kind::number) return a;
  if (a.kind == Kind::number && b.kind == Kind::element && !subtracts) return b;
  const bool fixed = a.kind == Kind::number || a.kind == Kind::address || a.kind == Kind::frame;
  if (b.kind == Kind::number && fixed) return {a.kind, subtracts ? a.at - b.at : a.at + b.at, -1};
  if (a.kind == Kind::number && b.kind == Kind::address && !subtracts)
    return address(static_cast<Address>(a.at + b.at));
  // an entry of a table of distances and the place that they count from
  if (a.kind == Kind::table && b.kind == Kind::address) return a;
  if (b.kind == Kind::table && a.kind == Kind::address) return b;
  return unknown;
}

}  // namespace

Origin of_task(int depth) { return {Kind::task, 0, -1, depth}; }

Origin join(const Origin& a, const Origin& b) {
  if (a.kind == Kind::nothing || a == b) return b;
  if (b.kind == Kind::nothing) return a;
  const std::int64_t loaded = a.loaded == b.loaded ? a.loaded : -1;
  if (a.kind == b.kind && a.at == b.at) return {a.kind, a.at, loaded, std::min(a.depth, b.depth)};
  return {is_own(a) && is_own(b) ? Kind::own : Kind::any, 0, loaded};
}

bool join_into(State& a, const State& b) {
  bool changed = (a.own_vectors & ~b.own_vectors) != 0;
  a.own_vectors &= b.own_vectors;
  for (std::size_t i = 0; i < a.registers.size(); ++i) {
    const Origin both = join(a.registers[i], b.registers[i]);
    changed = changed || both != a.registers[i];
    a.registers[i] = both;
  }
  for (auto at = a.stack.begin(); at != a.stack.end();) {
    const auto other = b.stack.find(at->first);
    const Origin both = other == b.stack.end() ? unknown : join(at->second, other->second);
    if (both == at->second) {
      ++at;
      continue;
    }
    changed = true;
    if (both.kind == Kind::any && both.loaded < 0) {
      at = a.stack.erase(at);
    } else {
      at->second = both;
      ++at;
    }
  }
  return changed;
}

// What lies at an address that is known.
Origin Values::loaded_from(Address at) const {
  if (const Pointer* const pointer = object_.pointer_at(at))
    return pointer->to == Pointer::To::address ? address(pointer->address) : Origin{Kind::library, 0, -1};
  return object_.place_of(at) == Place::constant ? Origin{Kind::table, static_cast<std::int64_t>(at), -1} : unknown;
}

// What an index that is not known leads to, from there; unknown: that is not in a constant table.
Origin Values::element_of(const Origin& table, std::int64_t displacement) const {
  if (table.kind == Kind::element) return table;
  const std::int64_t begin = table.at + displacement;
  const bool constant = table.kind == Kind::address && object_.place_of(static_cast<Address>(begin)) == Place::constant;
  return constant ? Origin{Kind::element, begin, -1} : unknown;
}

Origin Values::address_of(const Instruction& instruction, const Operand& operand, const State& state) const {
  if (operand.reg == instruction_pointer) return address(instruction.place(operand));
  const Origin base = operand.reg >= 0 ? state.registers[static_cast<std::size_t>(operand.reg)] : number(0);
  const Origin index = operand.index >= 0 ? state.registers[static_cast<std::size_t>(operand.index)] : number(0);
  if (operand.index < 0 && (base.kind == Kind::number || base.kind == Kind::address || base.kind == Kind::frame))
    return {base.kind, base.at + operand.number, -1};
  for (const Origin& table : {base, index})
    if (const Origin element = element_of(table, operand.number); element.kind == Kind::element) return element;
  if (base.kind == Kind::frame && index.kind == Kind::task) return spot(base.at + operand.number);
  if (index.kind == Kind::frame && base.kind == Kind::task && operand.scale == 1)
    return spot(index.at + operand.number);
  if (base.kind == Kind::spot && operand.index < 0) return spot(base.at + operand.number);
  if (base.kind == Kind::task || index.kind == Kind::task) return of_task(depth_of(base, index));
  return unknown;
}

std::optional<Address> Values::known_address(const Instruction& instruction, const Operand& operand,
                                             const State& state) const {
  if (operand.reg == instruction_pointer) return instruction.place(operand);
  if (instruction.form == Form::address) return std::nullopt;
  const Origin base = operand.reg >= 0 ? state.registers[static_cast<std::size_t>(operand.reg)] : number(0);
  const Origin index = operand.index >= 0 ? state.registers[static_cast<std::size_t>(operand.index)] : number(0);
  const bool known = (base.kind == Kind::address && index.kind == Kind::number) ||
                     (base.kind == Kind::number && index.kind == Kind::address && operand.scale == 1);
  if (!known) return std::nullopt;
  return static_cast<Address>(base.at + index.at * operand.scale + operand.number);
}

Origin Values::value_of(const Instruction& instruction, const Operand& operand, const State& state) const {
  switch (operand.kind) {
    case Operand::Kind::reg: return state.registers[static_cast<std::size_t>(operand.reg)];
    case Operand::Kind::number: return number(operand.number);
    case Operand::Kind::memory: break;
    default: return unknown;
  }
  const Origin base = operand.reg >= 0 ? state.registers[static_cast<std::size_t>(operand.reg)] : unknown;
  const Origin at = address_of(instruction, operand, state);
  switch (at.kind) {
    case Kind::address: return loaded_from(static_cast<Address>(at.at));
    case Kind::element: return {Kind::table, at.at, -1};
    case Kind::frame: {
      const auto slot = state.stack.find(at.at);
      return slot == state.stack.end() ? unknown : slot->second;
    }
    case Kind::spot: {
      // one of a table of addresses of its own, or what may be anything
      auto slot = state.stack.find(at.at);
      const std::int64_t begin = at.at;
      std::int64_t end = begin;
      for (; slot != state.stack.end() && slot->first == end && is_own(slot->second); ++slot) end += 8;
      const bool goes_on = slot != state.stack.end() && slot->first == end && slot->second.kind == Kind::task;
      return end > begin && !goes_on ? Origin{Kind::own, 0, -1} : of_task(1);
    }
    case Kind::task: return {Kind::task, 0, operand.index < 0 ? operand.number : -1, std::min(at.depth + 1, 8)};
    default: break;
  }
  // what a library's object holds: its table of virtual functions, and those
  const std::int64_t displacement = operand.index < 0 ? operand.number : -1;
  return {base.kind == Kind::library ? Kind::library : Kind::any, 0, displacement};
}

void Values::store(const Instruction& instruction, const Operand& to, const Origin& value, State& state) const {
  if (to.kind == Operand::Kind::reg) {
    state.registers[static_cast<std::size_t>(to.reg)] = value;
    return;
  }
  if (to.kind != Operand::Kind::memory) return;
  const Origin at = address_of(instruction, to, state);
  const bool may_stay = at.kind == Kind::spot && to.size == 8 && is_own(value);
  if ((at.kind != Kind::frame && at.kind != Kind::spot) || may_stay) return;
  const std::int64_t size = std::max<std::int64_t>(to.size, 1);
  state.stack.erase(state.stack.upper_bound(at.at - 8), state.stack.lower_bound(at.at + size));
  if (at.kind == Kind::spot || size % 8 != 0 || (value.kind == Kind::any && value.loaded < 0)) return;
  for (std::int64_t i = 0; i < size; i += 8) state.stack[at.at + i] = value;
}

// Does it write nothing but addresses of the task's own, of which vectors hold several?
bool Values::gathers_own(const Instruction& instruction, const State& state) const {
  return instruction.gathers &&
         std::all_of(instruction.operands.begin(), instruction.operands.end(), [&](const Operand& operand) {
           switch (operand.kind) {
             case Operand::Kind::none: return true;
             case Operand::Kind::number: return true;  // the place within the vector
             case Operand::Kind::vector: return !operand.read || (state.own_vectors >> operand.reg & 1U) != 0;
             default: return !operand.read || is_own(value_of(instruction, operand, state));
           }
         });
}

void Values::apply(const Instruction& instruction, State& state) const {
  const Operand &to = instruction.operands[0], &from = instruction.operands[1];
  switch (instruction.form) {
    case Form::move: return store(instruction, to, value_of(instruction, from, state), state);
    case Form::address: return store(instruction, to, address_of(instruction, from, state), state);
    case Form::add: {
      const Origin a = value_of(instruction, to, state), b = value_of(instruction, from, state);
      if (!instruction.subtracts)
        for (const auto& [table, index] : {std::pair(a, b), std::pair(b, a)})
          if (const Origin element = element_of(table, 0); element.kind == Kind::element && index.kind == Kind::task)
            return store(instruction, to, element, state);
      return store(instruction, to, sum(a, b, instruction.subtracts), state);
    }
    case Form::push:
      state.registers[rsp].at -= 8;
      if (state.registers[rsp].kind == Kind::frame)
        state.stack[state.registers[rsp].at] = value_of(instruction, to, state);
      return;
    case Form::pop: {
      Origin top = unknown;
      if (state.registers[rsp].kind == Kind::frame)
        if (const auto slot = state.stack.find(state.registers[rsp].at); slot != state.stack.end()) top = slot->second;
      store(instruction, to, top, state);
      state.registers[rsp].at += 8;
      return;
    }
    case Form::leave:
      state.registers[rsp] = state.registers[rbp];
      state.registers[rsp].at += 8;
      state.registers[rbp] = unknown;
      return;
    default: break;
  }
  // whatever else computes with a task's values makes a value of the task
  bool with_task = false;
  for (const Operand& operand : instruction.operands)
    if (operand.kind == Operand::Kind::reg)
      with_task = with_task || state.registers[static_cast<std::size_t>(operand.reg)].kind == Kind::task;
  const bool clears = to.kind == Operand::Kind::reg && from.kind == Operand::Kind::reg && to.reg == from.reg;
  for (std::size_t r = 0; r < 16; ++r)
    if ((instruction.writes >> r & 1U) != 0 && r != rsp)
      state.registers[r] = with_task && !clears ? of_task(0) : unknown;
  const bool own = gathers_own(instruction, state);
  if (to.kind == Operand::Kind::vector && to.written) {
    const std::uint32_t bit = 1U << to.reg;
    state.own_vectors = own ? state.own_vectors | bit : state.own_vectors & ~bit;
  }
  if (to.kind == Operand::Kind::memory && to.written)
    store(instruction, to, own ? Origin{Kind::own, 0, -1} : unknown, state);
}

bool Values::is_import(const Instruction& call, const State& state) const {
  const Operand& to = call.operands[0];
  if (to.kind != Operand::Kind::number) return value_of(call, to, state).kind == Kind::library;
  const Pointer* const pointer = object_.behind_stub(static_cast<Address>(to.number));
  return pointer != nullptr && pointer->to == Pointer::To::import;
}

void Values::call(const Instruction& instruction, State& state, State& thrown) const {
  const Origin result = is_import(instruction, state) ? Origin{Kind::library, 0, -1} : unknown;
  for (const Register r : {rax, rcx, rdx, rsi, rdi, Register{8}, Register{9}, Register{10}, Register{11}})
    state.registers[static_cast<std::size_t>(r)] = unknown;
  state.own_vectors = 0;
  state.registers[rax] = {Kind::library, 0, -1};  // as what is thrown is
  join_into(thrown, state);
  state.registers[rax] = result;
}

}  // namespace jarol::isolation

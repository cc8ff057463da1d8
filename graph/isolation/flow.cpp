#include "graph/isolation/flow.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "graph/isolation/names.h"

namespace jarol::isolation {
namespace {

using Kind = Origin::Kind;
using Form = Instruction::Form;

constexpr Register argument_registers[] = {rdi, rsi, rdx, rcx, r8, r9};
constexpr Origin unknown{Kind::any, 0, -1};

// What registers and the stack hold.
struct State {
  std::array<Origin, 16> registers{};
  std::map<std::int64_t, Origin> stack;
};

Origin address(Address at) { return {Kind::address, static_cast<std::int64_t>(at), -1}; }
Origin number(std::int64_t value) { return {Kind::number, value, -1}; }

Origin of_task(int depth) { return {Kind::task, 0, -1, depth}; }
// Of what is computed with the task's values.
int depth_of(const Origin& a, const Origin& b) {
  if (a.kind != Kind::task) return b.depth;
  return b.kind != Kind::task ? a.depth : std::min(a.depth, b.depth);
}

// Joins into `a`; true: it changed.
bool join_into(State& a, const State& b) {
  bool changed = false;
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

class Walk {
 public:
  Walk(const Object& object, const Symbol& function)
      : object_(object), function_(function), code_(decode(object, function.begin, function.end)) {}

  std::vector<Finding> findings(const Arguments& arguments) {
    if (code_.empty() || code_.back().next < function_.end) {
      const Address at = code_.empty() ? function_.begin : code_.back().next;
      offend(at, {"unreadable code", "", "holds bytes that are no instruction that is known here"});
    }
    find_blocks();
    State begin;
    for (Origin& origin : begin.registers) origin = unknown;
    for (std::size_t i = 0; i < arguments.size(); ++i)
      begin.registers[static_cast<std::size_t>(argument_registers[i])] = arguments[i];
    begin.registers[rsp] = {Kind::frame, 0, -1};
    if (code_.empty()) return std::move(found_);
    enter(0, begin);
    follow();
    // landing pads, and what is entered from elsewhere
    for (std::size_t i = 0; i < code_.size(); ++i)
      if (leaders_[i] && !entries_.contains(i)) {
        enter(i, after_calls_);
        follow();
      }
    report();
    return std::move(found_);
  }

 private:
  // the instruction at an address, or none
  std::size_t index_of(Address at) const {
    const auto found =
        std::lower_bound(code_.begin(), code_.end(), at, [](const Instruction& i, Address a) { return i.at < a; });
    return found != code_.end() && found->at == at ? static_cast<std::size_t>(found - code_.begin()) : code_.size();
  }
  bool is_inside(Address at) const { return at >= function_.begin && at < function_.end; }

  void find_blocks() {
    leaders_.assign(code_.size(), false);
    if (!code_.empty()) leaders_[0] = true;
    for (std::size_t i = 0; i < code_.size(); ++i) {
      const Instruction& instruction = code_[i];
      const bool jumps = instruction.form == Form::jump || instruction.form == Form::branch;
      if ((jumps || instruction.form == Form::end) && i + 1 < code_.size()) leaders_[i + 1] = true;
      if (!jumps || instruction.operands[0].kind != Operand::Kind::number) continue;
      const auto to = static_cast<Address>(instruction.operands[0].number);
      if (!is_inside(to)) continue;
      const std::size_t target = index_of(to);
      if (target == code_.size()) {
        offend(instruction.at, {"unreadable code", "", "jumps into the middle of an instruction"});
      } else {
        leaders_[target] = true;
      }
    }
  }

  void enter(std::size_t block, const State& state) {
    const auto [at, first] = entries_.emplace(block, state);
    if (first || join_into(at->second, state)) work_.insert(block);
  }

  void follow() {
    while (!work_.empty()) {
      const std::size_t block = *work_.begin();
      work_.erase(work_.begin());
      walk_block(block, false);
    }
  }

  void report() {
    for (const auto& [block, state] : entries_) walk_block(block, true);
  }

  void walk_block(std::size_t block, bool reports) {
    State state = entries_.at(block);
    for (std::size_t i = block; i < code_.size(); ++i) {
      if (i != block && leaders_[i]) return reports ? void() : enter(i, state);
      const Instruction& instruction = code_[i];
      if (reports) report_on(instruction, state);
      switch (instruction.form) {
        case Form::end: return;
        case Form::jump:
        case Form::branch:
          if (!reports) jump(instruction, state);
          if (instruction.form == Form::jump) return;
          break;
        default: apply(instruction, state); break;
      }
    }
  }

  void jump(const Instruction& instruction, const State& state) {
    const Operand& to = instruction.operands[0];
    if (to.kind == Operand::Kind::number) {
      if (const std::size_t target = index_of(static_cast<Address>(to.number)); target < code_.size())
        enter(target, state);
      return;
    }
    const Origin target = value_of(instruction, to, state);
    if (target.kind != Kind::table) return;
    for (const Address at : targets_of_table(static_cast<Address>(target.at)))
      if (const std::size_t index = index_of(at); is_inside(at) && index < code_.size()) {
        leaders_[index] = true;
        enter(index, state);
      }
  }

  // Of a table of addresses, or of distances from its own begin: all that lead into code, up to the first that doesn't.
  std::vector<Address> targets_of_table(Address table) const {
    std::vector<Address> targets;
    if (object_.pointer_at(table) != nullptr) {
      for (Address at = table; targets.size() < 4096; at += 8) {
        const Pointer* const pointer = object_.pointer_at(at);
        if (pointer == nullptr || pointer->to != Pointer::To::address || !is_inside(pointer->address)) break;
        targets.push_back(pointer->address);
      }
      return targets;
    }
    for (Address at = table; targets.size() < 4096; at += 4) {
      const Bytes entry = object_.bytes(at, at + 4);
      if (entry.empty()) break;
      std::int32_t distance = 0;
      std::memcpy(&distance, entry.data(), sizeof distance);
      const Address target = table + static_cast<Address>(static_cast<std::int64_t>(distance));
      const bool in_code = object_.place_of(target) == Place::code;
      if (!in_code || (is_inside(target) && index_of(target) == code_.size())) break;
      if (!is_inside(target) && !object_.function_at(target).is_cold()) break;
      targets.push_back(target);
    }
    return targets;
  }

  // What lies at an address that is known.
  Origin loaded_from(Address at) const {
    if (const Pointer* const pointer = object_.pointer_at(at))
      return pointer->to == Pointer::To::address ? address(pointer->address) : Origin{Kind::library, 0, -1};
    return object_.place_of(at) == Place::constant ? Origin{Kind::table, static_cast<std::int64_t>(at), -1} : unknown;
  }

  Origin address_of(const Instruction& instruction, const Operand& operand, const State& state) const {
    if (operand.reg == instruction_pointer) return address(instruction.place(operand));
    const Origin base = operand.reg >= 0 ? state.registers[static_cast<std::size_t>(operand.reg)] : number(0);
    const Origin index = operand.index >= 0 ? state.registers[static_cast<std::size_t>(operand.index)] : number(0);
    if (operand.index < 0 && (base.kind == Kind::number || base.kind == Kind::address || base.kind == Kind::frame))
      return {base.kind, base.at + operand.number, -1};
    // an element of a table: where that begins
    for (const Origin& table : {base, index}) {
      const std::int64_t begin = table.at + operand.number;
      if (table.kind == Kind::address && object_.place_of(static_cast<Address>(begin)) == Place::constant)
        return {Kind::table, begin, -1};
    }
    if (base.kind == Kind::task || index.kind == Kind::task) return of_task(depth_of(base, index));
    return unknown;
  }

  Origin value_of(const Instruction& instruction, const Operand& operand, const State& state) const {
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
      case Kind::table: return at;
      case Kind::frame: {
        const auto slot = state.stack.find(at.at);
        return slot == state.stack.end() ? unknown : slot->second;
      }
      case Kind::task: return {Kind::task, 0, operand.index < 0 ? operand.number : -1, std::min(at.depth + 1, 8)};
      default: break;
    }
    // what a library's object holds: its table of virtual functions, and those
    const std::int64_t displacement = operand.index < 0 ? operand.number : -1;
    return {base.kind == Kind::library ? Kind::library : Kind::any, 0, displacement};
  }

  void store(const Instruction& instruction, const Operand& to, const Origin& value, State& state) const {
    if (to.kind == Operand::Kind::reg) {
      state.registers[static_cast<std::size_t>(to.reg)] = value;
      return;
    }
    if (to.kind != Operand::Kind::memory) return;
    const Origin at = address_of(instruction, to, state);
    if (at.kind != Kind::frame) return;
    const std::int64_t size = std::max<std::int64_t>(to.size, 1);
    state.stack.erase(state.stack.upper_bound(at.at - 8), state.stack.lower_bound(at.at + size));
    if (size == 8 && !(value.kind == Kind::any && value.loaded < 0)) state.stack[at.at] = value;
  }

  static Origin sum(const Origin& a, const Origin& b, bool subtracts) {
    if (a.kind == Kind::task || b.kind == Kind::task) return of_task(depth_of(a, b));
    const bool fixed = a.kind == Kind::number || a.kind == Kind::address || a.kind == Kind::frame;
    if (b.kind == Kind::number && fixed) return {a.kind, subtracts ? a.at - b.at : a.at + b.at, -1};
    if (a.kind == Kind::number && b.kind == Kind::address && !subtracts)
      return address(static_cast<Address>(a.at + b.at));
    // an entry of a table of distances and the place that they count from
    if (a.kind == Kind::table && b.kind == Kind::address) return a;
    if (b.kind == Kind::table && a.kind == Kind::address) return b;
    return unknown;
  }

  void apply(const Instruction& instruction, State& state) {
    const Operand &to = instruction.operands[0], &from = instruction.operands[1];
    switch (instruction.form) {
      case Form::move: return store(instruction, to, value_of(instruction, from, state), state);
      case Form::address: return store(instruction, to, address_of(instruction, from, state), state);
      case Form::add: {
        const Origin both =
            sum(value_of(instruction, to, state), value_of(instruction, from, state), instruction.subtracts);
        return store(instruction, to, both, state);
      }
      case Form::push:
        state.registers[rsp].at -= 8;
        if (state.registers[rsp].kind == Kind::frame)
          state.stack[state.registers[rsp].at] = value_of(instruction, to, state);
        return;
      case Form::pop: {
        Origin top = unknown;
        if (state.registers[rsp].kind == Kind::frame)
          if (const auto slot = state.stack.find(state.registers[rsp].at); slot != state.stack.end())
            top = slot->second;
        store(instruction, to, top, state);
        state.registers[rsp].at += 8;
        return;
      }
      case Form::leave:
        state.registers[rsp] = state.registers[rbp];
        state.registers[rsp].at += 8;
        state.registers[rbp] = unknown;
        return;
      case Form::call: {
        const Origin result = is_import(instruction, state) ? Origin{Kind::library, 0, -1} : unknown;
        for (const Register r : {rax, rcx, rdx, rsi, rdi, Register{8}, Register{9}, Register{10}, Register{11}})
          state.registers[static_cast<std::size_t>(r)] = unknown;
        state.registers[rax] = {Kind::library, 0, -1};  // as what is thrown is
        join_into(after_calls_, state);
        state.registers[rax] = result;
        return;
      }
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
    if (to.kind == Operand::Kind::memory && to.written) store(instruction, to, unknown, state);
  }

  bool is_import(const Instruction& call, const State& state) const {
    const Operand& to = call.operands[0];
    if (to.kind != Operand::Kind::number) return value_of(call, to, state).kind == Kind::library;
    const Pointer* const pointer = object_.behind_stub(static_cast<Address>(to.number));
    return pointer != nullptr && pointer->to == Pointer::To::import;
  }

  void offend(Address at, Offence offence) {
    Finding finding;
    finding.what = Finding::What::offence;
    finding.at = at;
    finding.offence = std::move(offence);
    found_.push_back(std::move(finding));
  }

  void add(Finding::What what, Address at, Address to, std::string name = {}) {
    Finding finding;
    finding.what = what;
    finding.at = at;
    finding.to = to;
    finding.name = std::move(name);
    found_.push_back(std::move(finding));
  }

  void follow_pointer(Address at, const Pointer& pointer, Finding::What what, const State& state) {
    switch (pointer.to) {
      case Pointer::To::import: return add(Finding::What::import, at, 0, pointer.name);
      case Pointer::To::thread_local_data: return offend_thread_local(at, pointer.name);
      case Pointer::To::address: break;
    }
    add(what, at, pointer.address);
    if (what == Finding::What::call) found_.back().with = arguments_in(state);
  }

  void offend_thread_local(Address at, const std::string& mangled) {
    const std::string name = bare_name(demangled(mangled));
    offend(at, {"thread-local storage", name,
                name.empty() ? "reaches thread-local storage" : "reaches the thread-local '" + name + "'"});
  }

  static Arguments arguments_in(const State& state) {
    Arguments with;
    for (std::size_t i = 0; i < with.size(); ++i)
      with[i] = state.registers[static_cast<std::size_t>(argument_registers[i])];
    for (Origin& origin : with)
      if (origin.kind == Kind::frame) origin = unknown;
    return with;
  }

  void report_on(const Instruction& instruction, const State& state) {
    if (*instruction.forbidden != '\0')
      offend(instruction.at, {"forbidden instruction", instruction.text,
                              "holds the instruction '" + instruction.text + "', " + instruction.forbidden});
    const bool transfers =
        instruction.form == Form::call || instruction.form == Form::jump || instruction.form == Form::branch;
    if (transfers) return report_transfer(instruction, state);
    for (const Operand& operand : instruction.operands) {
      if (operand.kind != Operand::Kind::memory) continue;
      if (operand.thread_local_data) offend_thread_local(instruction.at, "");
      if (operand.reg != instruction_pointer) continue;
      const Address at = instruction.place(operand);
      const Pointer* const pointer = object_.pointer_at(at);
      const bool loads = instruction.form == Form::move || instruction.form == Form::push ||
                         instruction.form == Form::other || instruction.form == Form::add;
      // what the offset table holds is meant, not the place in it
      if (object_.place_of(at) == Place::offset_table && pointer != nullptr &&
          (loads || pointer->to == Pointer::To::thread_local_data)) {
        follow_pointer(instruction.at, *pointer, Finding::What::reference, state);
      } else {
        add(Finding::What::reference, instruction.at, at);
      }
    }
  }

  void report_transfer(const Instruction& instruction, const State& state) {
    const Operand& operand = instruction.operands[0];
    if (operand.thread_local_data) offend_thread_local(instruction.at, "");
    if (operand.kind == Operand::Kind::number) {
      const auto to = static_cast<Address>(operand.number);
      if (is_inside(to) && instruction.form != Form::call) return;
      if (const Pointer* const pointer = object_.behind_stub(to))
        return follow_pointer(instruction.at, *pointer, Finding::What::call, state);
      add(Finding::What::call, instruction.at, to);
      found_.back().with = arguments_in(state);
      return;
    }
    if (operand.kind == Operand::Kind::memory && operand.reg == instruction_pointer) {
      const Address at = instruction.place(operand);
      if (const Pointer* const pointer = object_.pointer_at(at))
        return follow_pointer(instruction.at, *pointer, Finding::What::call, state);
      add(Finding::What::reference, instruction.at, at);
    }
    const Origin target = value_of(instruction, operand, state);
    if (target.kind == Kind::address) {
      add(Finding::What::call, instruction.at, static_cast<Address>(target.at));
      found_.back().with = arguments_in(state);
      return;
    }
    if (target.kind == Kind::table) {
      for (const Address to : targets_of_table(static_cast<Address>(target.at)))
        if (!is_inside(to)) add(Finding::What::reference, instruction.at, to);
      return;
    }
    add(Finding::What::through_pointer, instruction.at, 0);
    found_.back().target = target;
  }

  const Object& object_;
  const Symbol function_;
  const std::vector<Instruction> code_;
  std::vector<bool> leaders_;             // begins of blocks
  std::map<std::size_t, State> entries_;  // what holds there
  std::set<std::size_t> work_;
  State after_calls_;  // what holds after any call, so that it does where what the call threw is caught
  std::vector<Finding> found_;
};

}  // namespace

Origin join(const Origin& a, const Origin& b) {
  if (a.kind == Kind::nothing || a == b) return b;
  if (b.kind == Kind::nothing) return a;
  const std::int64_t loaded = a.loaded == b.loaded ? a.loaded : -1;
  if (a.kind == b.kind && a.at == b.at) return {a.kind, a.at, loaded, std::min(a.depth, b.depth)};
  return {Kind::any, 0, loaded};
}

Arguments unknown_arguments() {
  Arguments all;
  all.fill(unknown);
  return all;
}

Arguments arguments_of_task() {
  Arguments all = unknown_arguments();
  all[0] = all[1] = of_task(0);
  return all;
}

Arguments arguments_of_run() {
  Arguments all;
  all.fill(of_task(1));
  return all;
}

std::vector<Finding> findings_in(const Object& object, const Symbol& function, const Arguments& arguments) {
  return Walk(object, function).findings(arguments);
}

}  // namespace jarol::isolation

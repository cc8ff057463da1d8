// In one file: one walk, whose steps share what they know of the function.
#include "graph/isolation/flow.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "graph/isolation/names.h"

namespace jarol::isolation {
namespace {

using Kind = Origin::Kind;
using Form = Instruction::Form;

constexpr Register argument_registers[] = {rdi, rsi, rdx, rcx, r8, r9};

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
    if (reads_guard_ && !is_protected())
      offend(*reads_guard_, {"thread-local storage", "", "reads the stack protector's number, which is random"});
    return std::move(found_);
  }

 private:
  // Does it end the process where that number is not what it was? What it calls for that may be in its cold part.
  bool is_protected() const {
    return function_.is_cold() || !object_.functions_named(function_.name + ".cold").empty() ||
           std::any_of(found_.begin(), found_.end(), [](const Finding& finding) {
             return finding.what == Finding::What::import && finding.name == "__stack_chk_fail";
           });
  }

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
        case Form::call: values_.call(instruction, state, after_calls_); break;
        default: values_.apply(instruction, state); break;
      }
    }
    if (reports) report_end();
  }

  // Without a return it goes on in whatever lies behind it; where a call is last that does not return.
  void report_end() {
    const Instruction& last = code_.back();
    if (last.form != Form::call && last.next == function_.end && object_.place_of(function_.end) == Place::code)
      add(Finding::What::call, last.at, function_.end);
  }

  void jump(const Instruction& instruction, const State& state) {
    const Operand& to = instruction.operands[0];
    if (to.kind == Operand::Kind::number) {
      if (const std::size_t target = index_of(static_cast<Address>(to.number)); target < code_.size())
        enter(target, state);
      return;
    }
    const Origin target = values_.value_of(instruction, to, state);
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
      case Pointer::To::copy:
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
      if (origin.kind == Kind::frame || origin.kind == Kind::own || origin.kind == Kind::spot) origin = unknown;
    return with;
  }

  void report_on(const Instruction& instruction, const State& state) {
    if (*instruction.forbidden != '\0')
      offend(instruction.at, {"forbidden instruction", instruction.text,
                              "holds the instruction '" + instruction.text + "', " + instruction.forbidden});
    const bool transfers =
        instruction.form == Form::call || instruction.form == Form::jump || instruction.form == Form::branch;
    if (transfers) return report_transfer(instruction, state);
    if (instruction.form == Form::add && counts_from_code(instruction, state))
      offend(instruction.at, {"the address of code", "",
                              "counts addresses from that of its code, which can't be followed; build it with -O1 or "
                              "more, and without -mcmodel=large"});
    for (const Operand& operand : instruction.operands) {
      if (operand.kind != Operand::Kind::memory) continue;
      if (operand.thread_local_data) offend_thread_local(instruction.at, "");
      if (operand.reads_guard && !puts_guard_aside(code_, instruction)) reads_guard_ = instruction.at;
      const std::optional<Address> at = values_.known_address(instruction, operand, state);
      if (!at) continue;
      const Pointer* const pointer = object_.pointer_at(*at);
      const bool loads = instruction.form == Form::move || instruction.form == Form::push ||
                         instruction.form == Form::other || instruction.form == Form::add;
      // what the offset table holds is meant, not the place in it, unless that is written to
      if (object_.place_of(*at) == Place::offset_table && pointer != nullptr && !operand.written &&
          (loads || pointer->to == Pointer::To::thread_local_data)) {
        follow_pointer(instruction.at, *pointer, Finding::What::reference, state);
      } else {
        add(Finding::What::reference, instruction.at, *at);
      }
    }
  }

  bool counts_from_code(const Instruction& instruction, const State& state) const {
    const Origin a = values_.value_of(instruction, instruction.operands[0], state);
    const Origin b = values_.value_of(instruction, instruction.operands[1], state);
    const auto is_code = [&](const Origin& of) {
      return of.kind == Kind::address && object_.place_of(static_cast<Address>(of.at)) == Place::code;
    };
    return (is_code(a) && b.kind == Kind::number) || (a.kind == Kind::number && is_code(b));
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
    const Origin target = values_.value_of(instruction, operand, state);
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
  const Values values_{object_};
  const Symbol function_;
  const std::vector<Instruction> code_;
  std::vector<bool> leaders_;             // begins of blocks
  std::map<std::size_t, State> entries_;  // what holds there
  std::set<std::size_t> work_;
  State after_calls_;  // what holds after any call, so that it does where what the call threw is caught
  std::optional<Address> reads_guard_;  // of the stack protector
  std::vector<Finding> found_;
};

}  // namespace

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

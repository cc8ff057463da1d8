#include "graph/isolation/instruction.h"

#include <capstone/capstone.h>

#include <memory>

#include "graph/isolation/forbidden.h"
#include "graph/text/errors.h"

namespace jarol::isolation {
namespace {

using Form = Instruction::Form;

// Debian's capstone frees what it gave by functions of its own.
class Disassembler {
 public:
  Disassembler() {
    if (cs_open(CS_ARCH_X86, CS_MODE_64, &handle_) != CS_ERR_OK) throw Unfinished("capstone can't be used");
    cs_option(handle_, CS_OPT_DETAIL, CS_OPT_ON);
    instruction_ = cs_malloc(handle_);
  }
  ~Disassembler() {
    cs_free(instruction_, 1);
    cs_close(&handle_);
  }
  Disassembler(const Disassembler&) = delete;
  Disassembler& operator=(const Disassembler&) = delete;

  /// The next instruction, or null.
  const cs_insn* next(const unsigned char*& code, std::size_t& left, Address& at) {
    return cs_disasm_iter(handle_, &code, &left, &at, instruction_) ? instruction_ : nullptr;
  }

 private:
  csh handle_ = 0;
  cs_insn* instruction_ = nullptr;
};

// The parts of a general register have its number.
constexpr auto make_registers() {
  std::array<Register, X86_REG_ENDING> numbers{};
  numbers.fill(no_register);
  constexpr x86_reg old[8][5] = {
      {X86_REG_RAX, X86_REG_EAX, X86_REG_AX, X86_REG_AL, X86_REG_AH},
      {X86_REG_RCX, X86_REG_ECX, X86_REG_CX, X86_REG_CL, X86_REG_CH},
      {X86_REG_RDX, X86_REG_EDX, X86_REG_DX, X86_REG_DL, X86_REG_DH},
      {X86_REG_RBX, X86_REG_EBX, X86_REG_BX, X86_REG_BL, X86_REG_BH},
      {X86_REG_RSP, X86_REG_ESP, X86_REG_SP, X86_REG_SPL, X86_REG_SPL},
      {X86_REG_RBP, X86_REG_EBP, X86_REG_BP, X86_REG_BPL, X86_REG_BPL},
      {X86_REG_RSI, X86_REG_ESI, X86_REG_SI, X86_REG_SIL, X86_REG_SIL},
      {X86_REG_RDI, X86_REG_EDI, X86_REG_DI, X86_REG_DIL, X86_REG_DIL},
  };
  for (Register r = 0; r < 8; ++r)
    for (const x86_reg part : old[r]) numbers[part] = r;
  // capstone numbers each kind of part of r8 to r15 in a row
  for (Register r = 0; r < 8; ++r)
    for (const x86_reg first : {X86_REG_R8, X86_REG_R8D, X86_REG_R8W, X86_REG_R8B})
      numbers[static_cast<std::size_t>(first + r)] = static_cast<Register>(8 + r);
  numbers[X86_REG_RIP] = instruction_pointer;
  return numbers;
}
static_assert(X86_REG_R15 == X86_REG_R8 + 7 && X86_REG_R15D == X86_REG_R8D + 7 && X86_REG_R15W == X86_REG_R8W + 7 &&
              X86_REG_R15B == X86_REG_R8B + 7);

Register register_of(unsigned reg) {
  static constexpr auto numbers = make_registers();
  return reg < numbers.size() ? numbers[reg] : no_register;
}

// xmm, ymm, zmm
Register vector_of(unsigned reg) {
  for (const unsigned first : {X86_REG_XMM0, X86_REG_YMM0, X86_REG_ZMM0})
    if (reg >= first && reg < first + 32) return static_cast<Register>(reg - first);
  return no_register;
}
static_assert(X86_REG_XMM31 == X86_REG_XMM0 + 31 && X86_REG_YMM31 == X86_REG_YMM0 + 31 &&
              X86_REG_ZMM31 == X86_REG_ZMM0 + 31);

// Whole numbers of eight bytes, as they are.
bool gathers(unsigned id) {
  switch (id) {
    case X86_INS_MOVQ:
    case X86_INS_MOVAPS:
    case X86_INS_MOVAPD:
    case X86_INS_MOVUPS:
    case X86_INS_MOVUPD:
    case X86_INS_MOVDQA:
    case X86_INS_MOVDQU:
    case X86_INS_MOVHPS:
    case X86_INS_MOVHPD:
    case X86_INS_MOVLHPS:
    case X86_INS_UNPCKLPD:
    case X86_INS_PUNPCKLQDQ:
    case X86_INS_PINSRQ: return true;
    default: return false;
  }
}

Instruction::Form form_of(const cs_insn& instruction) {
  switch (instruction.id) {
    case X86_INS_MOV:
    case X86_INS_MOVABS:
    case X86_INS_MOVZX:
    case X86_INS_MOVSX:
    case X86_INS_MOVSXD: return Form::move;
    case X86_INS_LEA: return Form::address;
    case X86_INS_ADD:
    case X86_INS_SUB: return Form::add;
    case X86_INS_PUSH: return Form::push;
    case X86_INS_POP: return Form::pop;
    case X86_INS_CALL: return Form::call;
    case X86_INS_JMP: return Form::jump;
    case X86_INS_LEAVE: return Form::leave;
    case X86_INS_RET:
    case X86_INS_UD2:
    case X86_INS_HLT:
    case X86_INS_INT3: return Form::end;
    default: break;
  }
  for (std::uint8_t i = 0; i < instruction.detail->groups_count; ++i)
    if (instruction.detail->groups[i] == CS_GRP_JUMP) return Form::branch;
  return Form::other;
}

Operand operand_of(const cs_x86_op& from) {
  Operand made;
  made.size = from.size;
  made.written = (from.access & CS_AC_WRITE) != 0;
  made.read = (from.access & CS_AC_READ) != 0 || !made.written;
  switch (from.type) {
    case X86_OP_REG:
      made.reg = register_of(from.reg);
      made.kind = made.reg == no_register ? Operand::Kind::other : Operand::Kind::reg;
      if (const Register vector = vector_of(from.reg); vector != no_register) {
        made.kind = Operand::Kind::vector;
        made.reg = vector;
      }
      break;
    case X86_OP_IMM:
      made.kind = Operand::Kind::number;
      made.number = from.imm;
      break;
    case X86_OP_MEM:
      made.kind = Operand::Kind::memory;
      made.reg = register_of(from.mem.base);
      made.index = register_of(from.mem.index);
      made.number = from.mem.disp;
      made.scale = static_cast<std::uint8_t>(from.mem.scale);
      if (from.mem.segment == X86_REG_FS || from.mem.segment == X86_REG_GS) {
        made.reads_guard = from.mem.segment == X86_REG_FS && from.mem.base == X86_REG_INVALID &&
                           from.mem.index == X86_REG_INVALID && from.mem.disp == 0x28 && !made.written;
        made.thread_local_data = !made.reads_guard;
      }
      break;
    default: break;
  }
  return made;
}

Instruction made_of(const cs_insn& from) {
  Instruction made;
  made.at = from.address;
  made.next = from.address + from.size;
  made.form = form_of(from);
  made.forbidden = reason_against(from);
  made.subtracts = from.id == X86_INS_SUB;
  made.gathers = gathers(from.id);
  made.x87 = from.mnemonic[0] == 'f' || uses_mmx(from);  // no other begins so
  if (*made.forbidden != '\0') made.text = name_of(from);
  const cs_x86& x86 = from.detail->x86;
  for (std::size_t i = 0; i < made.operands.size() && i < x86.op_count; ++i) {
    made.operands[i] = operand_of(x86.operands[i]);
    const Operand& operand = made.operands[i];
    if (operand.kind == Operand::Kind::reg && operand.written && operand.reg >= 0)
      made.writes = static_cast<std::uint16_t>(made.writes | 1U << operand.reg);
  }
  for (std::uint8_t i = 0; i < from.detail->regs_write_count; ++i)
    if (const Register reg = register_of(from.detail->regs_write[i]); reg >= 0 && reg != rsp)
      made.writes = static_cast<std::uint16_t>(made.writes | 1U << reg);
  made.clears = from.id == X86_INS_XOR && made.operands[0].kind == Operand::Kind::reg &&
                made.operands[1].kind == Operand::Kind::reg && made.operands[0].reg == made.operands[1].reg;
  return made;
}

// Up to the first bytes that are no instruction, or to where `stops` says so of what follows one.
template <class Stops>
void decode_on(Bytes bytes, Address at, const Stops& stops, std::vector<Instruction>& all) {
  static thread_local Disassembler disassembler;
  const unsigned char* code = bytes.data();
  std::size_t left = bytes.size();
  bool after_conversion = false;
  while (left > 0) {
    const cs_insn* const found = disassembler.next(code, left, at);
    if (found == nullptr) break;
    // compilers change the x87 control word around the conversion of a long double to an integer, and restore it
    const bool converts = found->id == X86_INS_FISTP;
    if (converts && !all.empty() && all.back().text == "fldcw") all.back().forbidden = "";
    all.push_back(made_of(*found));
    if (after_conversion && found->id == X86_INS_FLDCW) all.back().forbidden = "";
    after_conversion = converts;
    if (left > 0 && stops(all.back(), *code)) break;
  }
}

}  // namespace

std::vector<Instruction> decode(const Object& object, Address begin, Address end) {
  std::vector<Instruction> all;
  decode_on(
      object.bytes(begin, end), begin, [](const Instruction&, unsigned char) { return false; }, all);
  return all;
}

std::optional<std::vector<Instruction>> decode_section(Bytes code) {
  const auto is_padding = [](const Instruction& before, unsigned char next) {
    return next == 0 && (before.form == Form::end || before.form == Form::jump || before.form == Form::call);
  };
  std::vector<Instruction> all;
  for (std::size_t at = 0; at < code.size();) {
    const std::size_t known = all.size();
    decode_on(code.subspan(at), at, is_padding, all);
    if (all.size() == known) return std::nullopt;
    at = all.back().next;
    if (at < code.size() && code[at] != 0) return std::nullopt;
    while (at < code.size() && code[at] == 0) ++at;
  }
  return all;
}

bool puts_guard_aside(const std::vector<Instruction>& code, const Instruction& first) {
  const auto i = static_cast<std::size_t>(&first - code.data());
  if (i + 2 >= code.size() || first.form != Instruction::Form::move) return false;
  const Register guard = first.operands[0].reg;
  const Instruction &store = code[i + 1], &clear = code[i + 2];
  const Operand& place = store.operands[0];
  return store.form == Instruction::Form::move && place.kind == Operand::Kind::memory &&
         (place.reg == rsp || place.reg == rbp) && store.operands[1].reg == guard && clear.clears &&
         clear.operands[0].reg == guard;
}

}  // namespace jarol::isolation

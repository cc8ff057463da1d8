#include "graph/isolation/forbidden.h"

#include <algorithm>
#include <cstdint>

namespace jarol::isolation {
namespace {

// UMONITOR, UMWAIT and TPAUSE are MFENCE behind a prefix (Intel SDM volume 2): capstone 4 knows that alone.
bool waits_by_clock(const cs_insn& instruction) {
  const std::uint8_t first = instruction.bytes[0];
  return instruction.id == X86_INS_MFENCE && (first == 0x66 || first == 0xf2 || first == 0xf3);
}

// RDPID is RDSEED behind F3 (Intel SDM volume 2): capstone 4 knows that alone.
bool asks_for_core(const cs_insn& instruction) {
  return instruction.id == X86_INS_RDSEED && instruction.bytes[0] == 0xf3;
}

}  // namespace

bool uses_mmx(const cs_insn& instruction) {
  const cs_x86& x86 = instruction.detail->x86;
  return std::any_of(x86.operands, x86.operands + x86.op_count, [](const cs_x86_op& operand) {
    return operand.type == X86_OP_REG && operand.reg >= X86_REG_MM0 && operand.reg <= X86_REG_MM7;
  });
}

const char* name_of(const cs_insn& instruction) {
  if (asks_for_core(instruction)) return "rdpid";
  if (!waits_by_clock(instruction)) return instruction.mnemonic;
  switch (instruction.bytes[0]) {
    case 0x66: return "tpause";
    case 0xf2: return "umwait";
    default: return "umonitor";
  }
}

const char* reason_against(const cs_insn& instruction) {
  switch (instruction.id) {
    case X86_INS_SYSCALL:
    case X86_INS_SYSENTER:
    case X86_INS_INT:
    case X86_INS_INT1:
    case X86_INS_INTO: return "a system call";
    case X86_INS_RDTSC:
    case X86_INS_RDTSCP:
    case X86_INS_RDPMC: return "which reads a counter of cycles";
    case X86_INS_MFENCE:
      if (waits_by_clock(instruction)) return "which waits by a counter of cycles";
      break;
    case X86_INS_RCPPS:
    case X86_INS_RCPSS:
    case X86_INS_RSQRTPS:
    case X86_INS_RSQRTSS:
    case X86_INS_VRCPPS:
    case X86_INS_VRCPSS:
    case X86_INS_VRSQRTPS:
    case X86_INS_VRSQRTSS:
    case X86_INS_VRCP14PD:
    case X86_INS_VRCP14PS:
    case X86_INS_VRCP14SD:
    case X86_INS_VRCP14SS:
    case X86_INS_VRSQRT14PD:
    case X86_INS_VRSQRT14PS:
    case X86_INS_VRSQRT14SD:
    case X86_INS_VRSQRT14SS:
    case X86_INS_VRCP28PD:
    case X86_INS_VRCP28PS:
    case X86_INS_VRCP28SD:
    case X86_INS_VRCP28SS:
    case X86_INS_VRSQRT28PD:
    case X86_INS_VRSQRT28PS:
    case X86_INS_VRSQRT28SD:
    case X86_INS_VRSQRT28SS:
    case X86_INS_VEXP2PD:
    case X86_INS_VEXP2PS:
    case X86_INS_FSIN:
    case X86_INS_FCOS:
    case X86_INS_FSINCOS:
    case X86_INS_FPTAN:
    case X86_INS_FPATAN:
    case X86_INS_F2XM1:
    case X86_INS_FYL2X:
    case X86_INS_FYL2XP1: return "an approximation that differs from processor to processor";
    case X86_INS_RDRAND: return "which makes random numbers";
    case X86_INS_RDSEED:
      return asks_for_core(instruction) ? "which asks what processor or core this is" : "which makes random numbers";
    case X86_INS_CPUID:
    case X86_INS_XGETBV:
    case X86_INS_SGDT:
    case X86_INS_SIDT:
    case X86_INS_SLDT:
    case X86_INS_STR:
    case X86_INS_SMSW:
    case X86_INS_VERR:
    case X86_INS_VERW:
    case X86_INS_GETSEC:
    case X86_INS_ENCLU:
    case X86_INS_LSL:
    case X86_INS_LAR: return "which asks what processor or core this is";
    case X86_INS_LDMXCSR:
    case X86_INS_VLDMXCSR:
    case X86_INS_FXRSTOR:
    case X86_INS_FXRSTOR64:
    case X86_INS_XRSTOR:
    case X86_INS_XRSTOR64:
    case X86_INS_FLDCW:
    case X86_INS_FLDENV:
    case X86_INS_FRSTOR:
    case X86_INS_FNINIT:
    case X86_INS_FNCLEX:
    case X86_INS_FFREE:
    case X86_INS_FFREEP:
    case X86_INS_FINCSTP:
    case X86_INS_FDECSTP:
    case X86_INS_FEMMS:
    case X86_INS_EMMS: return "which changes the floating-point environment";
    case X86_INS_STMXCSR:
    case X86_INS_VSTMXCSR:
    case X86_INS_FXSAVE:
    case X86_INS_FXSAVE64:
    case X86_INS_XSAVE:
    case X86_INS_XSAVE64:
    case X86_INS_XSAVEOPT:
    case X86_INS_XSAVEOPT64:
    case X86_INS_XSAVEC:
    case X86_INS_XSAVEC64:
    case X86_INS_XSAVES:
    case X86_INS_XSAVES64:
    case X86_INS_FNSTENV:
    case X86_INS_FNSAVE:
    case X86_INS_FNSTSW: return "which reads the floating-point environment";
    case X86_INS_RDFSBASE:
    case X86_INS_RDGSBASE:
    case X86_INS_WRFSBASE:
    case X86_INS_WRGSBASE:
    case X86_INS_LFS:
    case X86_INS_LGS:
    case X86_INS_LSS:
    case X86_INS_XLATB:
    case X86_INS_SWAPGS: return "which reaches thread-local storage";
    case X86_INS_IN:
    case X86_INS_OUT:
    case X86_INS_INSB:
    case X86_INS_INSW:
    case X86_INS_INSD:
    case X86_INS_OUTSB:
    case X86_INS_OUTSW:
    case X86_INS_OUTSD: return "which talks to a device";
    case X86_INS_POPF:
    case X86_INS_POPFD:
    case X86_INS_POPFQ:
    case X86_INS_STD: return "which changes the processor's flags for others";
    case X86_INS_XBEGIN:
    case X86_INS_XABORT:
    case X86_INS_XTEST:
    case X86_INS_XEND: return "a memory transaction, which may fail at any time";
    case X86_INS_LCALL:
    case X86_INS_LJMP:
    case X86_INS_RETF:
    case X86_INS_RETFQ:
    case X86_INS_IRET:
    case X86_INS_IRETD:
    case X86_INS_IRETQ: return "a jump to another segment";
    // its place is in no operand
    case X86_INS_MASKMOVDQU:
    case X86_INS_VMASKMOVDQU:
      if (instruction.detail->x86.prefix[1] == X86_PREFIX_FS || instruction.detail->x86.prefix[1] == X86_PREFIX_GS)
        return "which writes thread-local storage";
      break;
    default: break;
  }
  if (uses_mmx(instruction)) return "which leaves the registers of long double in use";
  for (std::uint8_t i = 0; i < instruction.detail->groups_count; ++i) {
    const std::uint8_t group = instruction.detail->groups[i];
    // to end the process at once is no way out of it
    const bool ends = instruction.id == X86_INS_HLT || instruction.id == X86_INS_INT3 || instruction.id == X86_INS_UD2;
    if (group == CS_GRP_PRIVILEGE && !ends) return "which only a system may execute";
  }
  return "";
}

}  // namespace jarol::isolation

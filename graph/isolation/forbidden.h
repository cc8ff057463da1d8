// The instructions that no task may hold.
#pragma once

#include <capstone/capstone.h>

namespace jarol::isolation {

/// Why no task may hold an instruction, in words that follow its name; empty: it may.
const char* reason_against(const cs_insn& instruction);

/// As assemblers call it.
const char* name_of(const cs_insn& instruction);

/// It computes with the registers of MMX, which are those of long double.
bool uses_mmx(const cs_insn& instruction);

}  // namespace jarol::isolation

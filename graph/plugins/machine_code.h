// What an object file shows of the code in it, before that runs.
#pragma once

#include <string>

namespace jarol {

/// Why code in an object file or shared library might change the floating-point environment of its thread: an
/// instruction that loads it, or a call of something that is not known to leave it alone, in words that follow the
/// file's name: "calls 'fesetround'"; also that it computes with x87 registers, which it might leave in use. Empty: it
/// can't, so that arithmetic need not be looked at after its tasks. Knows ELF files for x86-64; sees no code that is
/// made at run time.
std::string find_floating_point_change(const std::string& path);

}  // namespace jarol

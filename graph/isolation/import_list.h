// What the code of a task may call or use outside of its library; everything else is refused.
#pragma once

#include <string>

namespace jarol::isolation {

/// Why a function or object of another library may be used; empty: it may not. Takes the name as the linker has it.
std::string reason_for(const std::string& name);

/// A function of Jarol's own that is trusted where it is defined, too: in the program that holds it.
bool is_own_library(const std::string& name);

/// A function of the C library's mathematics, of real or complex numbers of any precision.
bool is_mathematics(const std::string& name);

/// A function of the C library's mathematics that graph/math does not have, and whose last bits C leaves open: they may
/// differ with the processor.
bool is_of_c_library(const std::string& name);

/// What something that is refused is: "a clock"; empty: it is on no list.
std::string kind_of_refused(const std::string& name);

}  // namespace jarol::isolation

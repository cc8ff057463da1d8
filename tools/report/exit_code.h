// Exit codes of the command, as the README says, and which one counts where several apply.
#pragma once

#include <initializer_list>

namespace jarol::tools {

enum ExitCode { exit_good = 0, exit_negative = 1, exit_input = 2, exit_unfinished = 3 };

/// Of a program that a signal asked to end and that ended cleanly, as a shell has it: 130 for SIGINT. 0 for none.
int exit_of_signal(int signal);

/// Bad input before what was not brought to an end, that before a signal, that before a negative verdict.
int exit_of(std::initializer_list<int> codes);

}  // namespace jarol::tools

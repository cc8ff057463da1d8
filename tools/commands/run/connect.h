// The begin of a run's links and recording, while whoever waits at the terminal may change their mind.
#pragma once

#include <functional>

namespace jarol::tools {

/// What it throws after a signal has come is an end by that signal, EndedEarly: nothing has been run.
void connect_unless_ended(const std::function<void()>& connect);

}  // namespace jarol::tools

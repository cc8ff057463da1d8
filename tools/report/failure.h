// How the command reports what it can't do: text on stderr, and with --json one object on stdout.
#pragma once

#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

#include "graph/language/problems.h"
#include "graph/text/errors.h"

namespace jarol::tools {

/// Words of a command line that are not understood: what is wrong, then perhaps a line on where to read more.
struct UsageError : InputError {
  explicit UsageError(const std::string& wrong, std::string more_lines = "")
      : InputError(wrong), more(std::move(more_lines)) {}
  std::string more;
};

/// What check finds against a graph that is right: exit code 1.
struct NegativeVerdict : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A signal ended the command before it had anything to report.
struct EndedEarly : std::runtime_error {
  EndedEarly(int by, const std::string& text) : std::runtime_error(text), signal(by) {}
  int signal;
};

struct Failure {
  int exit_code = 0;
  std::vector<Problem> problems;
  std::string text;  // for people, with its line ends
};

/// Of an exception: bad input for SpecError, InputError and what a session refuses; a NegativeVerdict; not brought to
/// an end for Unfinished, and where memory, threads or the disk ran out; a file that can't be read or written by its
/// name is bad input; and all others are an error of ours. `file` is the one of several in which it was, or empty.
Failure failure_of(const std::exception_ptr& error, const std::string& file = "");

/// Prints it; the exit code. `file` as above.
int report(const Failure& failure, bool json, const std::string& file = "");

}  // namespace jarol::tools

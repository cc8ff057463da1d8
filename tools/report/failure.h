// How the command reports what it can't do: text on stderr, and with --json one object on stdout.
#pragma once

#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

#include "graph/language/problems.h"

namespace jarol::tools {

/// Words of a command line that are not understood: what is wrong, then perhaps a line on where to read more.
struct UsageError : std::invalid_argument {
  explicit UsageError(const std::string& wrong, std::string more_lines = "")
      : std::invalid_argument(wrong), more(std::move(more_lines)) {}
  std::string more;
};

/// What check finds against a graph that is right: exit code 1.
struct NegativeVerdict : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The machine does not let it come to its end, as where a disk is full: exit code 3.
struct Unfinished : std::runtime_error {
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

/// Of an exception: bad input for the types that are thrown for it, SpecError, std::invalid_argument, std::length_error
/// and std::runtime_error with all of a session's; a NegativeVerdict; the machine's where memory, threads or the disk
/// ran out; and an error of ours for all others. `file` is the one of several in which it was, or empty.
Failure failure_of(const std::exception_ptr& error, const std::string& file = "");

/// Prints it; the exit code. `file` as above.
int report(const Failure& failure, bool json, const std::string& file = "");

}  // namespace jarol::tools

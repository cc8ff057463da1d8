// What is thrown, by who is at fault; what is wrong with a graph is a SpecError. Any other exception that reaches main
// is an error of this program. Plain C++17, as units that include Simbody include it.
#pragma once

#include <new>
#include <stdexcept>
#include <string>
#include <system_error>

namespace jarol {

/// What the program was given can't be used as it is: options, names, files, addresses, parameters. The text says what
/// is wrong and what would be right.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Neither the input nor the program is at fault that it does not come to its end: the machine has too little of
/// something, or an external system is lost.
struct Unfinished : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// In a catch block around code that is not this program's, as that of a plugin's vehicle: what has no type of its own
/// is thrown again as what did not come to its end, by `who`.
[[noreturn]] inline void rethrow_as_unfinished(const std::string& who) {
  try {
    throw;
  } catch (const InputError&) { throw; } catch (const Unfinished&) {
    throw;
  } catch (const std::system_error&) { throw; } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) { throw Unfinished(who + ": " + error.what()); } catch (...) {
    throw Unfinished(who + ": it throws what is no std::exception");
  }
}

}  // namespace jarol

// What is thrown, by who is at fault; what is wrong with a graph is a SpecError. Any other exception that reaches main
// is an error of this program. Plain C++17, as units that include Simbody include it.
#pragma once

#include <stdexcept>

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

}  // namespace jarol

// Plain C++17, as units that include Simbody include it.
#pragma once

#include <stdexcept>

namespace jarol::vehicles {

/// A vehicle's motion has left what numbers can express; it can't be stepped any more.
class NoState : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace jarol::vehicles

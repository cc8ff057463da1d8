// Plain C++17, as units that include Simbody include it.
#pragma once

#include "graph/text/errors.h"

namespace jarol::vehicles {

/// A vehicle's motion has left what numbers can express; it can't be stepped any more.
class NoState : public Unfinished {
 public:
  using Unfinished::Unfinished;
};

}  // namespace jarol::vehicles

// Where plans of the tests are: the harbour of Leixoes.
#pragma once

#include "distributers/lauv/plan.h"
#include "graph/math/geometry.h"

namespace jarol::tests {
inline constexpr distributers::Origin origin{41.185 * degree, -8.7062 * degree};
}  // namespace jarol::tests

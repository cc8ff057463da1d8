// What the library brings.
#include <jarol/plugin.h>

#include "tasks/hold_level.h"

JAROL_PLUGIN(HoldLevel)

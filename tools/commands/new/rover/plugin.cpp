// What the library brings: a task, a distributer and a vehicle.
#include <jarol/plugin.h>

#include "distributer/rover_radio.h"
#include "tasks/drive_to.h"
#include "vehicle/rover.h"

JAROL_PLUGIN(DriveTo, RoverRadio, Rover)

// What instruments find in sea water, from temperature (degC), practical salinity and depth (m).
#pragma once

namespace jarol::vehicles {

/// S/m at the surface; solved from the practical salinity scale, UNESCO technical paper 44, 1983.
double calc_conductivity(double temperature, double salinity);

/// The practical salinity scale itself: salinity of water of that conductivity (S/m), without the small effect of
/// depth.
double calc_salinity(double conductivity, double temperature);

/// m/s; Medwin, "Speed of sound in water: a simple equation for realistic parameters", 1975.
double calc_sound_speed(double temperature, double salinity, double depth);

}  // namespace jarol::vehicles

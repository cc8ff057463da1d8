// Places in metres north and east of an origin, and on the ellipsoid of WGS-84 (NIMA TR8350.2): as graph/math/geometry.h
// has them, so that a plan is flown where it was drawn.

import type { Spot } from "./map.ts";

/** In radians. */
export interface LatLon {
  lat: number;
  lon: number;
}

const equatorial = 6378137;
const eccentricitySquared = 6.69437999014e-3;

/** Metres on the ground per radian: along the meridian, and along the circle of latitude. */
export function earthRadii(latitude: number): { north: number; east: number } {
  const sine = Math.sin(latitude);
  const w = 1 - eccentricitySquared * sine * sine;
  const normal = equatorial / Math.sqrt(w);
  return { north: (normal * (1 - eccentricitySquared)) / w, east: normal * Math.cos(latitude) };
}

export function latLonOf([north, east]: Spot, origin: LatLon): LatLon {
  const radii = earthRadii(origin.lat);
  return { lat: origin.lat + north / radii.north, lon: origin.lon + east / radii.east };
}

export function spotOf({ lat, lon }: LatLon, origin: LatLon): Spot {
  const radii = earthRadii(origin.lat);
  const turn = lon - origin.lon;
  const wrapped = turn - 2 * Math.PI * Math.round(turn / (2 * Math.PI));
  return [(lat - origin.lat) * radii.north, wrapped * radii.east];
}

// The path from above: what the map shows, in metres north and east.

export interface Frame {
  north: number; // of the middle
  east: number;
  scale: number; // points a metre
  width: number;
  height: number;
}

export type Spot = [north: number, east: number];

/** A length as people say it, 1, 2 or 5 times a power of ten, that is at most so long. */
export function roundLength(max: number): number {
  const power = 10 ** Math.floor(Math.log10(max));
  for (const step of [5, 2]) if (step * power <= max) return step * power;
  return power;
}

export function lengthText(metres: number): string {
  if (metres >= 1000) return `${metres / 1000} km`;
  return metres >= 1 ? `${metres} m` : `${Math.round(metres * 100)} cm`;
}

/** All spots in sight, with some room; at least so many metres. */
export function frameOf(spots: readonly Spot[], width: number, height: number, min: number): Frame {
  let [n0, n1, e0, e1] = [Infinity, -Infinity, Infinity, -Infinity];
  for (const [north, east] of spots) {
    n0 = Math.min(n0, north);
    n1 = Math.max(n1, north);
    e0 = Math.min(e0, east);
    e1 = Math.max(e1, east);
  }
  if (!Number.isFinite(n0)) [n0, n1, e0, e1] = [0, 0, 0, 0];
  // a map that is not laid out yet has no room
  const scale = Math.min(Math.max(1, width) / Math.max(min, (e1 - e0) * 1.25), Math.max(1, height) / Math.max(min, (n1 - n0) * 1.25));
  return { north: (n0 + n1) / 2, east: (e0 + e1) / 2, scale, width, height };
}

export function toPoint(frame: Frame, [north, east]: Spot): [x: number, y: number] {
  return [
    frame.width / 2 + (east - frame.east) * frame.scale,
    frame.height / 2 - (north - frame.north) * frame.scale,
  ];
}

export function toSpot(frame: Frame, x: number, y: number): Spot {
  return [
    frame.north - (y - frame.height / 2) / frame.scale,
    frame.east + (x - frame.width / 2) / frame.scale,
  ];
}

/** The nearest place whose numbers are round, some points wide. */
export function snapped(frame: Frame, [north, east]: Spot): Spot {
  const step = roundLength(8 / frame.scale);
  const round = (value: number) => Number((Math.round(value / step) * step).toPrecision(12)) || 0;
  return [round(north), round(east)];
}

/** The same spot stays under the point. */
export function zoomed(frame: Frame, factor: number, x: number, y: number): Frame {
  const [north, east] = toSpot(frame, x, y);
  const scale = Math.min(1e4, Math.max(1e-3, frame.scale * factor));
  return {
    ...frame,
    scale,
    north: north + (y - frame.height / 2) / scale,
    east: east - (x - frame.width / 2) / scale,
  };
}

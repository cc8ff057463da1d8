// Which published values say where a vehicle is and what its actuators do, by their types.

import type { Signal, Store } from "./series.ts";

export type VehicleKind = "helicopter" | "submarine";

export interface Place {
  x: Signal; // north
  y: Signal; // east
  down: Signal;
  downSign: 1 | -1;
  roll?: Signal;
  pitch?: Signal;
  heading: Signal;
  speed?: Signal;
}

export interface Vehicle {
  kind: VehicleKind;
  estimate?: Place;
  truth?: Place;
  actuators: { title: string; signal: Signal; max: number }[];
  states: Signal[];
  battery?: Signal;
  floor?: Signal; // true height above it
}

/** How fast the water or the air moves, in the mean. */
export interface Flow {
  of: "current" | "wind";
  north: number;
  east: number;
}

export interface Pose {
  x: number;
  y: number;
  down: number;
  roll: number;
  pitch: number;
  heading: number;
  speed: number;
}

type Paths = { x: string; y: string; down: string; roll: string; pitch: string; heading: string; speed?: string };

function placeOf(store: Store, type: string, paths: Paths, downSign: 1 | -1): Place | undefined {
  const find = store.ofType(type);
  const [x, y, down, heading] = [paths.x, paths.y, paths.down, paths.heading].map((path) => find?.(path));
  if (!find || !x || !y || !down || !heading) return undefined;
  return {
    x,
    y,
    down,
    downSign,
    heading,
    roll: find(paths.roll),
    pitch: find(paths.pitch),
    speed: paths.speed === undefined ? undefined : find(paths.speed),
  };
}

function defined<T>(all: (T | undefined)[]): T[] {
  return all.filter((one) => one !== undefined);
}

function submarine(store: Store): Vehicle | undefined {
  const estimate = placeOf(
    store,
    "Motion",
    { x: "x", y: "y", down: "z", roll: "phi", pitch: "theta", heading: "psi", speed: "u" },
    1,
  );
  const truth = placeOf(
    store,
    "SubmarineTruth",
    { x: "x", y: "y", down: "depth", roll: "roll", pitch: "pitch", heading: "heading", speed: "speed" },
    1,
  );
  if (!estimate && !truth) return undefined;
  const actuation = store.ofType("Actuation");
  const named = (title: string, path: string, max: number) => {
    const signal = actuation?.(path);
    return signal && { title, signal, max };
  };
  return {
    kind: "submarine",
    estimate,
    truth,
    actuators: defined([
      named("propeller", "thruster", 1),
      named("fin bottom", "fins.0", 0.5),
      named("fin port", "fins.1", 0.5),
      named("fin starboard", "fins.2", 0.5),
      named("fin top", "fins.3", 0.5),
    ]),
    states: defined([store.ofType("Condition")?.("alarm")]),
    battery: store.ofType("Instruments")?.("voltage.value"),
    floor: store.ofType("SubmarineTruth")?.("altitude"),
  };
}

function helicopter(store: Store): Vehicle | undefined {
  const estimate = placeOf(
    store,
    "FlightEstimate",
    { x: "x", y: "y", down: "altitude", roll: "roll", pitch: "pitch", heading: "yaw", speed: "climb" },
    -1,
  );
  const truth = placeOf(
    store,
    "HelicopterTruth",
    { x: "x", y: "y", down: "altitude", roll: "roll", pitch: "pitch", heading: "yaw", speed: "climb" },
    -1,
  );
  if (!estimate && !truth) return undefined;
  const motors = store.ofType("MotorCommand");
  const directive = store.ofType("FlightDirective");
  return {
    kind: "helicopter",
    estimate,
    truth,
    actuators: defined(
      ["front", "right", "rear", "left"].map((title, i) => {
        const signal = motors?.(`signals.${i}`);
        return signal && { title: `motor ${title}`, signal, max: 16000 };
      }),
    ),
    states: defined([directive?.("state"), directive?.("cause"), directive?.("hold_position")]),
    battery: store.ofType("FlightEstimate")?.("battery"),
  };
}

/** Undefined: the graph has no vehicle that is known here. */
export function vehicleOf(store: Store): Vehicle | undefined {
  return submarine(store) ?? helicopter(store);
}

export function poseAt(store: Store, place: Place, t: number): Pose | undefined {
  const read = (signal: Signal | undefined) => (signal ? store.number(signal, t) : 0);
  const pose = {
    x: read(place.x),
    y: read(place.y),
    down: read(place.down) * place.downSign,
    roll: read(place.roll),
    pitch: read(place.pitch),
    heading: read(place.heading),
    speed: read(place.speed),
  };
  return Number.isFinite(pose.x + pose.y + pose.down + pose.roll + pose.pitch + pose.heading) ? pose : undefined;
}

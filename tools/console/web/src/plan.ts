// A plan as it is drawn: maneuvers in their order, what is wrong with them, and the same as IMC's PlanSpecification.

import { latLonOf, spotOf, type LatLon } from "./geodesy.ts";
import type { Spot } from "./map.ts";
import type { Fields } from "./protocol.ts";
import type { Limits } from "./submarine.ts";

export const kinds = ["Goto", "FollowPath", "Loiter", "StationKeeping", "Surface"] as const;
export type Kind = (typeof kinds)[number];

export interface Maneuver {
  kind: Kind;
  spots: Spot[]; // of a path its corners, of Surface none, else one
  depth: number; // m
  speed: number; // m/s
  radius: number; // m, of Loiter, StationKeeping and Surface
  duration: number; // s, of Loiter and StationKeeping; 0: without end
}

export const hasRadius = (kind: Kind) => kind === "Loiter" || kind === "StationKeeping" || kind === "Surface";
export const hasDuration = (kind: Kind) => kind === "Loiter" || kind === "StationKeeping";

/** What the vehicle can fly: smaller circles it widens by itself. */
export const min = { speed: 0.5, radius: 10 };
export const max = { radius: 500, duration: 65535, away: 5000, maneuvers: 40, corners: 100, name: 40 };

/** As maneuvers are named in the plan: by kind and place. */
export const nameOf = (maneuver: Maneuver, index: number) => `${maneuver.kind} ${index + 1}`;

const distance = ([n, e]: Spot, [m, f]: Spot) => Math.hypot(n - m, e - f);
/** On which it turns from line to line, as guidance has it. */
const turningRadius = (speed: number) => speed / 0.125;

export interface Finding {
  maneuver?: number; // else it is of the whole plan
  text: string;
  /** It can be flown all the same. */
  mild: boolean;
}

export function check(name: string, plan: readonly Maneuver[], limits: Limits, from: Spot = [0, 0]): Finding[] {
  const found: Finding[] = [];
  const add = (text: string, maneuver?: number, mild = false) =>
    found.push({ text, mild, ...(maneuver === undefined ? {} : { maneuver }) });
  if (name.trim() === "") add("the plan has no name");
  if (name.length > max.name) add(`the plan's name has more than ${max.name} characters`);
  if (plan.length === 0) add("there is no maneuver; choose one and press on the map");
  if (plan.length > max.maneuvers) add(`there are more than ${max.maneuvers} maneuvers`);
  let before = from;
  plan.forEach((maneuver, i) => {
    const { kind, spots, depth, speed, radius, duration } = maneuver;
    const range = (what: string, value: number, low: number, high: number, unit: string) => {
      if (!(value >= low && value <= high)) add(`${what} from ${low} to ${high} ${unit}`, i);
    };
    if (kind !== "Surface") range("depth", depth, 0, limits.depth, "m");
    range("speed", speed, min.speed, limits.speed, "m/s");
    if (hasRadius(kind)) range("radius", radius, min.radius, max.radius, "m");
    if (hasDuration(kind)) {
      range("time", duration, 0, max.duration, "s");
      if (!Number.isInteger(duration)) add("time in whole seconds", i);
      if (duration === 0 && i + 1 < plan.length) add("it has no end, so that nothing after it is flown", i);
    }
    if (kind === "FollowPath" && spots.length < 2) add("a path has at least two corners", i);
    if (spots.length > max.corners) add(`a path has at most ${max.corners} corners`, i);
    for (const spot of spots) {
      if (!spot.every(Number.isFinite)) add("places are numbers", i);
      else if (Math.hypot(...spot) > max.away) add(`places are within ${max.away / 1000} km of home`, i);
      const near = 2 * turningRadius(speed);
      if (kind !== "Loiter" && kind !== "StationKeeping" && (i > 0 || spot !== spots[0]) && distance(before, spot) < near)
        add(`less than ${Math.ceil(near)} m from the place before: too near to turn in`, i, true);
      before = spot;
    }
  });
  return found;
}

/** The way that it flies from place to place, m, and how long that takes, s; endless maneuvers count nothing. */
export function lengthOf(plan: readonly Maneuver[], from: Spot = [0, 0]): { metres: number; seconds: number } {
  const all = { metres: 0, seconds: 0 };
  let before = from;
  for (const { spots, speed, duration, kind } of plan) {
    for (const spot of spots) {
      all.metres += distance(before, spot);
      all.seconds += distance(before, spot) / speed;
      before = spot;
    }
    if (!hasDuration(kind)) continue;
    all.seconds += duration;
    if (kind === "Loiter") all.metres += duration * speed;
  }
  return all;
}

type Inline = { abbrev: string; fields: Fields };

function inlineOf(maneuver: Maneuver, origin: LatLon): Inline {
  const { kind, spots, depth, speed, radius, duration } = maneuver;
  const place = spots[0] ? latLonOf(spots[0], origin) : {};
  const common = { ...place, speed, speed_units: "METERS_PS" };
  const level = { z: depth, z_units: "DEPTH" };
  switch (kind) {
    case "Goto":
      return { abbrev: kind, fields: { ...common, ...level } };
    case "FollowPath": {
      const [north, east] = spots[0] ?? [0, 0];
      const points = spots.map(([n, e]) => ({ abbrev: "PathPoint", fields: { x: n - north, y: e - east, z: 0 } }));
      return { abbrev: kind, fields: { ...common, ...level, points } };
    }
    case "Loiter":
      return { abbrev: kind, fields: { ...common, ...level, radius, duration, type: "CIRCULAR", direction: "CLOCKW" } };
    case "StationKeeping":
      return { abbrev: kind, fields: { ...common, ...level, radius, duration } };
    case "Surface":
      // IMC has no such maneuver: it goes up on a spiral where it is
      return {
        abbrev: "Elevator",
        fields: { ...common, flags: ["CURR_POS"], radius, end_z: 0, end_z_units: "DEPTH", start_z_units: "DEPTH" },
      };
  }
}

/** PlanSpecification, flown from first to last. */
export function specificationOf(name: string, plan: readonly Maneuver[], origin: LatLon): Inline {
  const names = plan.map(nameOf);
  const maneuvers = plan.map((maneuver, i) => ({
    abbrev: "PlanManeuver",
    fields: { maneuver_id: names[i], data: inlineOf(maneuver, origin) },
  }));
  const transitions = names.slice(1).map((to, i) => ({
    abbrev: "PlanTransition",
    fields: { source_man: names[i], dest_man: to, conditions: "ManeuverIsDone" },
  }));
  return { abbrev: "PlanSpecification", fields: { plan_id: name, start_man_id: names[0] ?? "", maneuvers, transitions } };
}

const number = (value: unknown) => (typeof value === "number" ? value : 0);

/** A part of a plan that the vehicle has, as far as it can be drawn. */
export interface Drawn {
  name: string;
  spots: Spot[];
  radius: number; // 0: no circle
}

/** Of a PlanSpecification, as drawn here or elsewhere: where it goes. */
export function drawingOf(specification: Fields, origin: LatLon): Drawn[] {
  const list = Array.isArray(specification["maneuvers"]) ? (specification["maneuvers"] as (Inline | null)[]) : [];
  return list.flatMap((each) => {
    const data = each?.fields?.["data"] as Inline | null | undefined;
    if (!each || !data?.fields) return [];
    const { lat, lon, radius, points, flags } = data.fields;
    const here = data.abbrev === "Elevator" && (number(flags) & 1) === 1;
    const start: Spot[] = here || typeof lat !== "number" || typeof lon !== "number" ? [] : [spotOf({ lat, lon }, origin)];
    const [north, east] = start[0] ?? [0, 0];
    const corners = (Array.isArray(points) ? (points as Inline[]) : []).map(
      ({ fields }): Spot => [north + number(fields["x"]), east + number(fields["y"])],
    );
    const circles = data.abbrev === "Loiter" || data.abbrev === "StationKeeping";
    return {
      name: String(each.fields["maneuver_id"] ?? ""),
      spots: corners.length > 0 ? corners : start,
      radius: circles ? number(radius) : 0,
    };
  });
}

/** The same of one that is being drawn. */
export function drawingOfDraft(plan: readonly Maneuver[]): Drawn[] {
  return plan.map((maneuver, i) => ({
    name: nameOf(maneuver, i),
    spots: maneuver.spots,
    radius: hasDuration(maneuver.kind) ? maneuver.radius : 0,
  }));
}

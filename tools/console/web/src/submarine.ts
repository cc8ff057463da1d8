// What a pilot at the desk commands a submarine: depth, heading and speed, or rudder and propeller by hand, in IMC as
// Neptus sends it.

import type { Fields, Hello } from "./protocol.ts";
import { clamp, wrapped, type Places, type StickPlan } from "./sticks.ts";

export const stickNames = ["turn", "drive", "dive"] as const;
/** To starboard, ahead, down. */
export type Sticks = Places<(typeof stickNames)[number]>;

export const stickPlan: StickPlan<keyof Sticks> = {
  names: stickNames,
  keys: {
    ArrowLeft: ["turn", -1],
    ArrowRight: ["turn", 1],
    KeyA: ["turn", -1],
    KeyD: ["turn", 1],
    KeyW: ["drive", 1],
    KeyS: ["drive", -1],
    ArrowUp: ["dive", -1],
    ArrowDown: ["dive", 1],
  },
  axes: { turn: [0, 1], drive: [1, -1], dive: [3, 1] },
};

export interface Limits {
  depth: number; // m
  speed: number; // m/s
}
/** The depth at which the vehicle would come up by itself is a metre deeper. */
export function limitsOf(hello: Hello): Limits {
  const supervisor = hello.tasks.find((task) => task.type === "LauvSupervisor");
  const depth = Number(supervisor?.parameters.find(({ path }) => path === "max_depth")?.value ?? "12");
  return { depth: Number.isFinite(depth) ? Math.max(0, depth - 1) : 11, speed: 1.6 };
}

/** How fast full sticks move the goals, a second. */
export const rates = { turn: Math.PI / 9, drive: 0.4, dive: 0.5 };

export type Steering = "" | "autopilot" | "hand";

export interface Known {
  depth: number;
  heading: number;
  speed: number;
}

/** Floats, does not move: there is nothing to hold. */
const afloat = 0.3;
const adrift = 0.2;

export class Goals implements Known {
  depth = 0;
  heading = 0;
  speed = 0;

  /** Whoever takes over changes nothing: goals are what is commanded, or where the vehicle is. */
  adopt(known: Known, limits: Limits): void {
    const finite = (value: number) => (Number.isFinite(value) ? value : 0);
    const [depth, speed] = [finite(known.depth), finite(known.speed)];
    this.depth = depth < afloat ? 0 : clamp(depth, limits.depth, 0);
    this.heading = wrapped(finite(known.heading));
    this.speed = speed < adrift ? 0 : clamp(speed, limits.speed, 0);
  }

  /** By hand rudder and propeller are the sticks' own. */
  move(sticks: Sticks, seconds: number, steering: Steering, limits: Limits): void {
    this.depth = clamp(this.depth + sticks.dive * rates.dive * seconds, limits.depth, 0);
    if (steering === "hand") return;
    this.heading = wrapped(this.heading + sticks.turn * rates.turn * seconds);
    this.speed = clamp(this.speed + sticks.drive * rates.drive * seconds, limits.speed, 0);
  }

  /** What says so, at each turn; where nothing is steered, that the operator is there. */
  messages(sticks: Sticks, steering: Steering, teleoperated: boolean): [message: string, fields: Fields][] {
    const depth: [string, Fields] = ["DesiredZ", { value: this.depth, z_units: "DEPTH" }];
    if (steering === "autopilot")
      return [
        depth,
        ["DesiredHeading", { value: this.heading }],
        ["DesiredSpeed", { value: this.speed, speed_units: "METERS_PS" }],
      ];
    if (steering === "") return [["Heartbeat", {}]];
    const axis = (place: number) => Math.round(place * 127) || 0;
    const hand: [string, Fields] = [
      "RemoteActions",
      { actions: `Heading=${axis(sticks.turn)};Thrust=${axis(sticks.drive)}` },
    ];
    // before it is steered by hand a depth would have the autopilot steer
    return teleoperated ? [hand, depth] : [hand];
  }
}

/** Of VehicleState and PlanControlState, numbers as in IMC. */
const modes = { error: 2, maneuver: 3, external: 4 };
const teleoperation = 452;
const executing = 3;

export interface Phase {
  kind: "unknown" | "rest" | "autopilot" | "hand" | "plan" | "aborted" | "alarm";
  text: string;
  mood: "good" | "warn" | "bad" | "";
  /** Of a plan. */
  maneuver?: string;
}

/** What the vehicle does, as it says; `alarm`: why it comes up, or "none". */
export function phaseOf(vehicle: Fields | undefined, plan: Fields | undefined, alarm: string): Phase {
  if (alarm !== "" && alarm !== "none")
    return { kind: "alarm", text: `comes up: ${alarm.replaceAll("_", " ")}`, mood: "bad" };
  const mode = vehicle?.["op_mode"];
  if (mode === undefined) return { kind: "unknown", text: "", mood: "" };
  if (mode === modes.error) return { kind: "aborted", text: "aborted", mood: "bad" };
  if (mode === modes.external) return { kind: "autopilot", text: "on autopilot", mood: "good" };
  if (mode !== modes.maneuver) return { kind: "rest", text: "at rest", mood: "" };
  if (vehicle?.["maneuver_type"] === teleoperation) return { kind: "hand", text: "by hand", mood: "good" };
  const runs = plan?.["state"] === executing;
  const maneuver = runs ? String(plan["man_id"]) : "";
  return { kind: "plan", text: `plan ${runs ? String(plan["plan_id"]) : ""}: ${maneuver}`, mood: "good", maneuver };
}

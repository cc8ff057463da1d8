// What a pilot at the desk commands a helicopter: sticks that spring back, and the goals that they move, in the messages of
// the JAviator's terminal.

import { clamp, wrapped, type Places, type StickPlan } from "./sticks.ts";

export const stickNames = ["roll", "pitch", "turn", "climb"] as const;
/** To the right, forward, to the right, up. */
export type Sticks = Places<(typeof stickNames)[number]>;

export const limits = {
  lean: 0.15, // rad, of a full stick
  speed: 0.6, // m/s, at which a full stick moves the goal where position is held
  turn: 0.8, // rad/s
  climb: 0.5, // m/s
  altitude: 2.2, // m
  yaw: Math.PI,
  away: 20, // m
};

/** Where the vehicle is, as far as it says. */
export interface Known {
  x: number;
  y: number;
  altitude: number;
  yaw: number;
  position: boolean; // it holds its position
  flies: boolean;
}

export class Goals {
  x = 0;
  y = 0;
  altitude = 0;
  yaw = 0;

  /** Who takes over, or changes the mode, changes nothing else. */
  adopt(known: Known): void {
    this.x = known.x;
    this.y = known.y;
    this.yaw = wrapped(known.yaw);
    this.altitude = known.flies ? clamp(known.altitude, limits.altitude, 0) : 0;
  }

  /** The sticks move them: along the nose and across it where position is held. */
  move(sticks: Sticks, seconds: number, position: boolean): void {
    this.altitude = clamp(this.altitude + sticks.climb * limits.climb * seconds, limits.altitude, 0);
    this.yaw = wrapped(this.yaw + sticks.turn * limits.turn * seconds);
    if (!position) return;
    const [ahead, aside] = [sticks.pitch * limits.speed * seconds, sticks.roll * limits.speed * seconds];
    const [cos, sin] = [Math.cos(this.yaw), Math.sin(this.yaw)];
    this.x = clamp(this.x + ahead * cos - aside * sin, limits.away);
    this.y = clamp(this.y + ahead * sin + aside * cos, limits.away);
  }

  /** The fields of COMMAND_DATA: thousandths; the same two numbers say how it leans or where it is. */
  command(sticks: Sticks, position: boolean): Record<string, number> {
    const milli = (value: number) => Math.round(value * 1000) || 0;
    return {
      roll: milli(position ? this.y : sticks.roll * limits.lean),
      // nose down is forward
      pitch: milli(position ? this.x : -sticks.pitch * limits.lean),
      yaw: milli(this.yaw),
      z: milli(this.altitude),
    };
  }
}

export const stickPlan: StickPlan<keyof Sticks> = {
  names: stickNames,
  keys: {
    ArrowLeft: ["roll", -1],
    ArrowRight: ["roll", 1],
    ArrowUp: ["pitch", 1],
    ArrowDown: ["pitch", -1],
    KeyA: ["turn", -1],
    KeyD: ["turn", 1],
    KeyW: ["climb", 1],
    KeyS: ["climb", -1],
  },
  axes: { turn: [0, 1], climb: [1, -1], roll: [2, 1], pitch: [3, -1] },
};

/** The one thing that SWITCH_STATE does next; undefined: nothing now. */
export function nextSwitch(state: string, cause: string): string | undefined {
  if (state === "halt") return "Arm";
  if (state === "ground") return cause === "none" ? "Take off" : "Acknowledge";
  if (state === "starting") return "Stop";
  return state === "flying" ? "Land" : undefined;
}

/** What that key does ends a flight. */
export function endsFlight(key: string | undefined): boolean {
  return key === "Land" || key === "Stop";
}

/**
 * One switch that does another thing each time: a second press must not undo the first, nor start motors, while the page
 * does not know yet what came of it.
 */
export class StateSwitch {
  private key: string | undefined;
  private since = -Infinity;
  private pressed: { milliseconds: number; newest: number } | undefined;
  /** Milliseconds that a key which starts something has to be seen before it counts. */
  static readonly seen = 600;
  /** Seconds, of the run and beside it, in which the vehicle follows: whoever looks at what is older commands nothing. */
  static readonly patience = 4;

  /** What it does next is that. */
  show(key: string | undefined, milliseconds: number): void {
    if (key === this.key) return;
    // it may have taken off before it heard of Stop, and lands
    if (!endsFlight(this.key) || !endsFlight(key)) this.pressed = undefined;
    this.key = key;
    this.since = milliseconds;
  }

  /** What the press does; undefined: it does not count. What ends a flight counts at once. */
  press(milliseconds: number, newest: number): string | undefined {
    if (!endsFlight(this.key) && milliseconds - this.since < StateSwitch.seen) return undefined;
    const { pressed } = this;
    const { patience } = StateSwitch;
    if (pressed && (newest - pressed.newest < patience || milliseconds - pressed.milliseconds < 1000 * patience)) return undefined;
    if (this.key !== undefined) this.wait(milliseconds, newest);
    return this.key;
  }

  /** Something was sent after which it does something else. */
  wait(milliseconds: number, newest: number): void {
    this.pressed = { milliseconds, newest };
  }
  /** What was sent was refused, or somebody else commands. */
  forget(): void {
    this.pressed = undefined;
  }

  /** It was told to take off, and has not said yet that it does. */
  get isStarting(): boolean {
    return this.key === "Take off" && this.pressed !== undefined;
  }
}

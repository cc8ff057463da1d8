// What a pilot at the desk commands a helicopter: sticks that spring back, and the goals that they move, in the messages of
// the JAviator's terminal.

/** Each from -1 to 1. */
export interface Sticks {
  roll: number; // to the right
  pitch: number; // forward
  turn: number; // to the right
  climb: number;
}
export const stickNames = ["roll", "pitch", "turn", "climb"] as const;

export const limits = {
  lean: 0.15, // rad, of a full stick
  speed: 0.6, // m/s, at which a full stick moves the goal where position is held
  turn: 0.8, // rad/s
  climb: 0.5, // m/s
  altitude: 2.2, // m
  yaw: Math.PI,
  away: 20, // m
};

/** A stick that is nearly centred is. */
export const deadZone = 0.08;
export function withDeadZone(value: number): number {
  const size = Math.abs(value);
  if (!Number.isFinite(size) || size < deadZone) return 0;
  return Math.sign(value) * Math.min(1, (size - deadZone) / (1 - deadZone));
}

const clamp = (value: number, most: number, least = -most) => Math.min(most, Math.max(least, value));
/** To within half a turn. */
export const wrapped = (angle: number) => angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));

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

/** Which key moves which stick. */
const keys: Record<string, [keyof Sticks, number]> = {
  ArrowLeft: ["roll", -1],
  ArrowRight: ["roll", 1],
  ArrowUp: ["pitch", 1],
  ArrowDown: ["pitch", -1],
  KeyA: ["turn", -1],
  KeyD: ["turn", 1],
  KeyW: ["climb", 1],
  KeyS: ["climb", -1],
};
export const isStickKey = (code: string) => code in keys;

/** Keys, pads on the screen and a gamepad, whichever is moved most. */
export class StickInput {
  private readonly held = new Set<string>();
  readonly pads: Sticks = { roll: 0, pitch: 0, turn: 0, climb: 0 };

  press(code: string): void {
    if (isStickKey(code)) this.held.add(code);
  }
  lift(code: string): void {
    this.held.delete(code);
  }
  /** Nobody holds anything any more. */
  letGo(): void {
    this.held.clear();
    for (const name of stickNames) this.pads[name] = 0;
  }

  read(gamepad: readonly number[] = []): Sticks {
    const [turn = 0, down = 0, roll = 0, back = 0] = gamepad.map(withDeadZone);
    const pad: Sticks = { roll, pitch: -back, turn, climb: -down };
    const read = { ...this.pads };
    for (const name of stickNames) if (Math.abs(pad[name]) > Math.abs(read[name])) read[name] = pad[name];
    for (const code of this.held) {
      const [name, way] = keys[code]!;
      read[name] = clamp(read[name] + way, 1);
    }
    return read;
  }
}

/** The one thing that SWITCH_STATE does next; undefined: nothing now. */
export function nextSwitch(state: string, cause: string): string | undefined {
  if (state === "halt") return "Arm";
  if (state === "ground") return cause === "none" ? "Take off" : "Acknowledge";
  if (state === "starting") return "Stop";
  return state === "flying" ? "Land" : undefined;
}

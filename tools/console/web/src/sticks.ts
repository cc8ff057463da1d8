// Sticks that spring back: keys, pads on the screen and a gamepad, whichever is moved most.

/** A stick that is nearly centred is. */
export const deadZone = 0.08;
export function withDeadZone(value: number): number {
  const size = Math.abs(value);
  if (!Number.isFinite(size) || size < deadZone) return 0;
  return Math.sign(value) * Math.min(1, (size - deadZone) / (1 - deadZone));
}

export const clamp = (value: number, max: number, min = -max) => Math.min(max, Math.max(min, value));
/** To within half a turn. */
export const wrapped = (angle: number) => angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));

/** Of each stick, from -1 to 1, by its name. */
export type Places<Name extends string> = Record<Name, number>;

export interface StickPlan<Name extends string> {
  names: readonly Name[];
  /** Which key moves which stick, and which way. */
  keys: Record<string, [Name, number]>;
  /** Which axis of a gamepad is which stick, and its sign. */
  axes: Partial<Record<Name, [axis: number, sign: number]>>;
}

export class StickReader<Name extends string> {
  private readonly plan: StickPlan<Name>;
  private readonly held = new Set<string>();
  readonly pads: Places<Name>;

  constructor(plan: StickPlan<Name>) {
    this.plan = plan;
    this.pads = this.centred();
  }

  isKey(code: string): boolean {
    return code in this.plan.keys;
  }
  press(code: string): void {
    if (this.isKey(code)) this.held.add(code);
  }
  /** A key goes down: it moves its stick, unless it is meant for what has the focus or for the browser. */
  keyDown(event: KeyboardEvent): void {
    if (!this.isKey(event.code) || event.ctrlKey || event.metaKey || event.altKey) return;
    if (takesKeys(event.target)) return;
    event.preventDefault();
    this.press(event.code);
  }
  lift(code: string): void {
    this.held.delete(code);
  }
  /** Nobody holds anything any more. */
  letGo(): void {
    this.held.clear();
    Object.assign(this.pads, this.centred());
  }
  centred(): Places<Name> {
    return Object.fromEntries(this.plan.names.map((name) => [name, 0])) as Places<Name>;
  }

  read(gamepad: readonly number[] = []): Places<Name> {
    const read = { ...this.pads };
    for (const name of this.plan.names) {
      const [axis, sign] = this.plan.axes[name] ?? [-1, 0];
      const place = sign * withDeadZone(gamepad[axis] ?? 0) || 0;
      if (Math.abs(place) > Math.abs(read[name])) read[name] = place;
    }
    for (const code of this.held) {
      const [name, way] = this.plan.keys[code]!;
      read[name] = clamp(read[name] + way, 1);
    }
    return read;
  }
}

/** The axes of the first gamepad that has two sticks. */
export function gamepadAxes(): readonly number[] {
  return [...navigator.getGamepads()].find((one) => one?.connected && one.axes.length >= 4)?.axes ?? [];
}

/** Whether keys are meant for what has the focus, not for a stick. */
export function takesKeys(target: EventTarget | null): boolean {
  if (!(target instanceof HTMLElement) || target.closest(".desk [type=range]")) return false;
  return target.matches("input, select, textarea, [role=separator], .map");
}

/** A key that is held presses no button again. */
export function dropHeld(event: KeyboardEvent): void {
  if (event.repeat && event.key === "Enter" && event.target instanceof HTMLButtonElement) event.preventDefault();
}

// of browsers that can't tell, none: that key counts
function isOpen(select: HTMLSelectElement): boolean {
  try {
    return select.matches(":open");
  } catch {
    return false;
  }
}

/** The key by which who commands ends it safely, wherever the focus is: not one that closes a list. */
export function isEscape(event: KeyboardEvent): boolean {
  if (event.key !== "Escape" || event.repeat) return false;
  return !(event.target instanceof HTMLSelectElement && isOpen(event.target));
}

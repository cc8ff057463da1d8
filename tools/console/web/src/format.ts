// Numbers as people read them: angles in degrees, everything with its unit.

import type { Cell, Leaf } from "./protocol.ts";

const degrees = 180 / Math.PI;

/** Factor and unit in which a unit is shown. */
export function shownUnit(unit: string): { factor: number; unit: string } {
  if (unit === "rad") return { factor: degrees, unit: "°" };
  if (unit === "rad/s") return { factor: degrees, unit: "°/s" };
  return { factor: 1, unit };
}

/** With so many digits after the point; without their number three, and what is too small for them with its exponent. */
export function formatNumber(value: number, digits?: number): string {
  if (!Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (size >= 1e6 || (digits === undefined && size !== 0 && size < 1e-4)) return value.toExponential(2);
  const after = digits ?? 3;
  const text = value.toFixed(size >= 1000 ? 0 : size >= 100 ? Math.min(1, after) : after);
  return Number(text) === 0 ? text.replace("-", "") : text;
}

/** The evenly spaced marks of an axis, all with the digits that the distance between them has. */
export function formatMarks(marks: readonly number[]): string[] {
  const step = Math.abs((marks[1] ?? 1) - (marks[0] ?? 0));
  const power = Math.floor(Math.log10(step) + 1e-9);
  const parts = step / 10 ** power; // 1, 2, 2.5 or 5
  const digits = (Math.abs(parts - Math.round(parts)) < 1e-6 ? 0 : 1) - power;
  const far = Math.max(...marks.map(Math.abs));
  return marks.map((mark) => {
    if (Math.abs(mark) < step / 2) return "0";
    return far >= 1e6 || digits > 5
      ? mark.toExponential(Math.max(0, Math.floor(Math.log10(Math.abs(mark)) + 1e-9) + digits))
      : mark.toFixed(Math.max(0, digits));
  });
}

export function wordOf(leaf: Leaf, value: number): string {
  return leaf.words?.find((word) => word.number === value)?.name ?? String(value);
}

export function formatCell(leaf: Leaf, cell: Cell): string {
  if (cell === null || (typeof cell === "number" && Number.isNaN(cell))) return "–";
  if (typeof cell !== "number") return typeof cell === "string" ? cell : JSON.stringify(cell);
  if (leaf.kind === "bool") return cell === 0 ? "no" : "yes";
  if (leaf.kind === "enum") return wordOf(leaf, cell);
  const { factor, unit } = shownUnit(leaf.unit);
  const number = Number.isInteger(cell) && factor === 1 ? String(cell) : formatNumber(cell * factor);
  return unit === "" ? number : `${number}\u202f${unit}`;
}

export function formatDuration(seconds: number): string {
  const size = Math.abs(seconds);
  if (size >= 1) return `${trim(seconds)} s`;
  if (size >= 1e-3) return `${trim(seconds * 1e3)} ms`;
  return `${trim(seconds * 1e6)} µs`;
}

export function formatTime(seconds: number): string {
  const sign = seconds < 0 ? "-" : "";
  const whole = Math.abs(seconds);
  const minutes = Math.floor(whole / 60);
  const rest = (whole - minutes * 60).toFixed(2).padStart(5, "0");
  return `${sign}${minutes}:${rest}`;
}

function trim(value: number): string {
  return String(Number(value.toPrecision(3)));
}

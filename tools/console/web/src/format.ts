// Numbers as people read them: angles in degrees, everything with its unit.

import type { Cell, Leaf } from "./protocol.ts";

const degrees = 180 / Math.PI;

/** Factor and unit in which a unit is shown. */
export function shownUnit(unit: string): { factor: number; unit: string } {
  if (unit === "rad") return { factor: degrees, unit: "°" };
  if (unit === "rad/s") return { factor: degrees, unit: "°/s" };
  return { factor: 1, unit };
}

export function formatNumber(value: number, digits = 3): string {
  if (!Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (size !== 0 && (size >= 1e6 || size < 1e-4)) return value.toExponential(2);
  const text = value.toFixed(size >= 1000 ? 0 : size >= 100 ? Math.min(1, digits) : digits);
  return Number(text) === 0 ? text.replace("-", "") : text;
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

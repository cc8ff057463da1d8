// What plots show: which signals, over which time, as columns of equal length.

import { shownUnit } from "./format.ts";
import type { Hello } from "./protocol.ts";
import type { Signal, Store } from "./series.ts";

export type Line = { signal: Signal; role: "commanded" | "reached" | "true" | "other" };
export interface PlotSpec {
  title: string;
  lines: Line[];
}

/** Commanded against reached, and where the vehicle truly is: what a run is judged by. Else the first few numbers. */
export function defaultPlots(hello: Hello, store: Store, max = 6): PlotSpec[] {
  const plots: PlotSpec[] = [];
  for (const pair of hello.pairs) {
    const commanded = store.find(pair.commanded);
    const reached = store.find(pair.reached);
    if (!commanded || !reached || commanded.description.kind !== "number") continue;
    const lines: Line[] = [
      { signal: commanded, role: "commanded" },
      { signal: reached, role: "reached" },
    ];
    const truth = store.signals.find(
      ({ output, description }) =>
        hello.outputs[output]?.kind === "truth" &&
        description.path === reached.description.path &&
        description.unit === reached.description.unit,
    );
    if (truth) lines.push({ signal: truth, role: "true" });
    plots.push({ title: pair.title, lines });
  }
  if (plots.length > 0) return plots.slice(0, max);
  return store.signals
    .filter(({ description }) => description.kind === "number")
    .slice(0, 3)
    .map((signal) => ({ title: signal.name, lines: [{ signal, role: "other" }] }));
}

/** The same plots with the signals of another store, as it is made after a break; what it lacks is left out. */
export function plotsOf(store: Store, plots: readonly PlotSpec[]): PlotSpec[] {
  const found = plots.map(({ title, lines }) => ({
    title,
    lines: lines.flatMap(({ signal, role }) => {
      const its = store.find(signal.name);
      return its ? [{ signal: its, role }] : [];
    }),
  }));
  return found.filter(({ lines }) => lines.length > 0);
}

/** Of an angle that is never more than half a turn, a turn is a jump: there is a gap in its line. */
function isJump(unit: string, from: number, to: number): boolean {
  return unit === "rad" && Math.abs(to - from) > Math.PI * 1.5;
}

/**
 * Instants of all lines between `from` and `to`, and for each line its value there (undefined: none of its own; null: a gap), at most
 * about `most` of each. A value holds until the next one, so lines begin with what held at `from`.
 */
export function columnsOf(
  store: Store,
  lines: readonly Line[],
  from: number,
  to: number,
  max: number,
): [number[], ...(number | null | undefined)[][]] {
  const picked = lines.map(({ signal }) => {
    const series = store.series[signal.output]!;
    const first = Math.max(0, series.at(from));
    const end = series.at(to) + 1;
    const stride = Math.max(1, Math.ceil((end - first) / max));
    const at: number[] = [];
    for (let i = first; i < end; i += stride) at.push(i);
    if (end > first && at[at.length - 1] !== end - 1) at.push(end - 1);
    return { series, at, column: series.columns[signal.leaf]!, ...shownUnit(signal.description.unit) };
  });
  const times = [...new Set(picked.flatMap(({ series, at }) => at.map((i) => series.times[i]!)))].sort((a, b) => a - b);
  const rows = new Map(times.map((t, row) => [t, row]));
  const columns = picked.map(({ series, at, column, factor }, line) => {
    const values = new Array<number | null | undefined>(times.length).fill(undefined);
    let before = NaN, last = 0;
    for (const i of at) {
      const value = column[i]!;
      const row = rows.get(series.times[i]!)!;
      values[row] = Number.isFinite(value) ? value * factor : null;
      if (isJump(lines[line]!.signal.description.unit, before, value)) {
        // a gap between the two; where no other line has an instant between them, in place of the second
        if (row > last + 1) values.fill(null, last + 1, row);
        else values[row] = null;
      }
      [before, last] = [value, row];
    }
    return values;
  });
  return [times, ...columns];
}

/** All that was published of these lines between the instants: a row for each instant at which any was. */
export function csvOf(store: Store, lines: readonly Line[], from: number, to: number): string {
  const quoted = (text: string) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
  const head = ["time", ...lines.map(({ signal }) => signal.name)].map(quoted).join(",");
  const units = ["s", ...lines.map(({ signal }) => signal.description.unit)].map(quoted).join(",");
  const rows = new Map<number, string[]>();
  lines.forEach(({ signal }, line) => {
    const series = store.series[signal.output]!;
    for (let i = 0; i < series.count; ++i) {
      const t = series.times[i]!;
      if (t < from || t > to) continue;
      let row = rows.get(t);
      if (!row) rows.set(t, (row = new Array<string>(lines.length).fill("")));
      row[line] = String(series.columns[signal.leaf]![i]);
    }
  });
  const sorted = [...rows].sort(([a], [b]) => a - b);
  return [head, units, ...sorted.map(([t, cells]) => [String(t), ...cells].join(","))].join("\n") + "\n";
}

// What was published, by output: instants and the numbers of its leaves, in columns that grow up to a limit. Beyond it
// the older half is thinned, so that memory stays flat and the whole run is there.

import type { Cell, Leaf, Output, Sample } from "./protocol.ts";

export class Series {
  readonly output: Output;
  count = 0;
  times: Float64Array;
  readonly columns: Float64Array[];
  readonly texts: (Cell[] | null)[]; // of leaves that are no numbers, one a sample
  private readonly max: number;

  constructor(output: Output, max = 40_000) {
    this.output = output;
    this.max = max;
    this.times = new Float64Array(256);
    this.columns = output.leaves.map(() => new Float64Array(256));
    this.texts = output.leaves.map((leaf) => (leaf.kind === "text" ? [] : null));
  }

  /** Instants never go back; a sample of an instant that is there replaces it. */
  add(t: number, cells: readonly Cell[]): void {
    if (this.count > 0 && t < this.times[this.count - 1]!) return;
    if (this.count > 0 && t === this.times[this.count - 1]) --this.count;
    if (this.count === this.max) this.thin();
    if (this.count === this.times.length) this.grow();
    this.times[this.count] = t;
    this.columns.forEach((column, i) => {
      const cell = cells[i];
      column[this.count] = typeof cell === "number" ? cell : NaN;
      const texts = this.texts[i];
      if (texts) texts[this.count] = cell ?? null;
    });
    ++this.count;
  }

  /** Index of the newest sample at or before t; -1: there is none. */
  at(t: number): number {
    let low = 0;
    let high = this.count;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.times[middle]! <= t) low = middle + 1;
      else high = middle;
    }
    return low - 1;
  }

  number(leaf: number, t: number): number {
    const index = this.at(t);
    return index < 0 ? NaN : this.columns[leaf]![index]!;
  }

  cell(leaf: number, index: number): Cell {
    return this.texts[leaf]?.[index] ?? this.columns[leaf]![index]!;
  }

  private grow(): void {
    const size = Math.min(this.max, this.times.length * 2);
    const larger = (from: Float64Array) => {
      const to = new Float64Array(size);
      to.set(from);
      return to;
    };
    this.times = larger(this.times);
    this.columns.forEach((column, i) => (this.columns[i] = larger(column)));
  }

  // every second one of the older half goes
  private thin(): void {
    const half = this.count >> 1;
    let to = 0;
    for (let from = 0; from < this.count; ++from) {
      if (from < half && from % 2 === 1) continue;
      this.times[to] = this.times[from]!;
      for (const column of this.columns) column[to] = column[from]!;
      for (const texts of this.texts) if (texts) texts[to] = texts[from] ?? null;
      ++to;
    }
    this.count = to;
    for (const texts of this.texts) if (texts) texts.length = to;
  }
}

export interface Signal {
  name: string;
  output: number;
  leaf: number;
  description: Leaf;
}

/** All that was published of a run. */
export class Store {
  readonly series: (Series | null)[];
  readonly signals: Signal[] = [];
  private readonly byName = new Map<string, Signal>();
  newest = 0;

  constructor(outputs: (Output | null)[], max?: number) {
    this.series = outputs.map((output) => (output ? new Series(output, max) : null));
    outputs.forEach((output, i) => {
      output?.leaves.forEach((description, leaf) => {
        const name = description.path === "" ? output.name : `${output.name}.${description.path}`;
        const signal = { name, output: i, leaf, description };
        this.signals.push(signal);
        this.byName.set(name, signal);
      });
    });
  }

  add(samples: readonly Sample[]): void {
    for (const [output, t, ...cells] of samples) {
      this.series[output]?.add(t, cells);
      if (t > this.newest) this.newest = t;
    }
  }

  find(name: string): Signal | undefined {
    return this.byName.get(name);
  }

  number(signal: Signal, t: number): number {
    return this.series[signal.output]!.number(signal.leaf, t);
  }

  /** Of an output with that type the signals by path; undefined: there is none. Truth only where it is asked for. */
  ofType(type: string): ((path: string) => Signal | undefined) | undefined {
    const index = this.series.findIndex((series) => series?.output.type === type);
    if (index < 0) return undefined;
    const output = this.series[index]!.output;
    return (path) => this.byName.get(`${output.name}.${path}`);
  }
}

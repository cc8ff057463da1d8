// What the drawing of the graph shows of a run at an instant.

import { formatCell } from "./format.ts";
import type { Cell, Hello, Leaf } from "./protocol.ts";
import type { Store } from "./series.ts";

export interface NodeState {
  period: number; // 0: none
  age: number | undefined; // since it published last; undefined: it has not
  stale: boolean; // it has missed more than two of its turns
  faults: number;
  slack: number | undefined;
  /** The one that says most of what it has published last, in few words; empty: none. */
  value: string;
}

export interface ShownValue {
  title: string;
  leaf: Leaf;
  cell: Cell;
}

interface NodeInfo {
  period: number;
  patience: number; // seconds without a publication until it is stale
  slack: number | undefined;
  outputs: number[];
  telling: { output: number; leaf: number } | undefined;
}

/** Of larger graphs values are shown of what is chosen alone. */
const maxWithValues = 60;

export class GraphModel {
  /** In ascending order. */
  readonly periods: number[];
  private readonly store: Store;
  private readonly hello: Hello;
  private readonly nodes: NodeInfo[];

  constructor(hello: Hello, store: Store) {
    this.hello = hello;
    this.store = store;
    this.nodes = hello.drawing.nodes.map((node) => this.infoOf(node.kind, node.name));
    this.periods = [...new Set(this.nodes.map((node) => node.period).filter((period) => period > 0))].sort(
      (a, b) => a - b,
    );
  }

  state(node: number, t: number, faults: ReadonlyMap<string, number>): NodeState {
    const info = this.nodes[node]!;
    let age: number | undefined;
    for (const output of info.outputs) {
      const series = this.store.series[output];
      const index = series?.at(t) ?? -1;
      if (series && index >= 0) age = Math.min(age ?? Infinity, t - series.times[index]!);
    }
    const { kind, name } = this.hello.drawing.nodes[node]!;
    const told = this.nodes.length <= maxWithValues ? info.telling : undefined;
    return {
      value: told ? this.told(told.output, told.leaf, t) : "",
      period: info.period,
      age,
      stale: age !== undefined && age > info.patience,
      faults: kind === "task" ? (faults.get(name) ?? 0) : 0,
      slack: info.slack,
    };
  }

  values(node: number, t: number): ShownValue[] {
    return this.nodes[node]!.outputs.flatMap((output) => {
      const series = this.store.series[output]!;
      const index = series.at(t);
      const port = series.output.name.split(".")[1];
      return series.output.leaves.map((leaf, i) => ({
        title: [port, leaf.path].filter((part) => part).join("."),
        leaf,
        cell: index < 0 ? null : series.cell(i, index),
      }));
    });
  }

  private told(output: number, leaf: number, t: number): string {
    const series = this.store.series[output]!;
    const index = series.at(t);
    if (index < 0) return "";
    const { path } = series.output.leaves[leaf]!;
    const text = `${path.split(".").at(-1)} ${formatCell(series.output.leaves[leaf]!, series.cell(leaf, index))}`.trim();
    return text.length > 24 ? `${text.slice(0, 23)}…` : text;
  }

  // what plots show of it, else its first number or word
  private tellingOf(outputs: number[]): NodeInfo["telling"] {
    const plotted = new Set(this.hello.pairs.flatMap(({ commanded, reached }) => [commanded, reached]));
    let first: NodeInfo["telling"];
    for (const output of outputs) {
      const { name, leaves } = this.hello.outputs[output]!;
      for (const [leaf, { path, kind }] of leaves.entries()) {
        if (plotted.has(path === "" ? name : `${name}.${path}`)) return { output, leaf };
        if (kind !== "text") first ??= { output, leaf };
      }
    }
    return first;
  }

  private infoOf(kind: string, name: string): NodeInfo {
    if (kind === "distributer") {
      const outputs = this.hello.outputs.flatMap((o, i) => (o?.kind === "truth" && o.of === name ? [i] : []));
      return { period: 0, patience: Infinity, slack: undefined, outputs, telling: undefined };
    }
    const of = kind === "task" ? "task" : "communicator";
    const outputs = this.hello.outputs.flatMap((o, i) => (o?.kind === of && o.of === name ? [i] : []));
    const task = kind === "task" ? this.hello.tasks.find((one) => one.name === name) : undefined;
    const communicator = this.hello.communicators.find((one) => one.name === name);
    const period = (kind === "task" ? task?.period : communicator?.period) ?? 0;
    return { period, patience: 2 * period + (task?.let ?? 0) + 0.2, slack: task?.slack, outputs, telling: this.tellingOf(outputs) };
  }
}

const colours = ["#2e86de", "#16a085", "#c08a1e", "#9b59b6", "#d35488", "#7f8c8d"];

export function colourOfPeriod(period: number, periods: readonly number[]): string {
  return colours[Math.min(Math.max(periods.indexOf(period), 0), colours.length - 1)]!;
}

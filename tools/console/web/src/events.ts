// What happened, in words: faults, and what the vehicle's own decisions tell the outside.

import { wordOf } from "./format.ts";
import type { Hello, RunEvent, Sample } from "./protocol.ts";

export interface Event {
  t: number;
  kind: "fault" | "rest" | "told" | "operator" | "page";
  text: string;
  task?: string; // of a fault
}

export const mostEvents = 1000;

interface Watch {
  output: number;
  leaf: number;
  name: string;
  last: number | undefined;
}

/** Notes when an enumeration that goes out changes and either word has a meaning, or is a state. */
export class EventLog {
  readonly all: Event[] = [];
  dropped = 0;
  private readonly hello: Hello;
  private readonly watches: Map<number, Watch[]>;

  constructor(hello: Hello) {
    this.hello = hello;
    this.watches = new Map();
    const outward = new Set(hello.communicators.filter((c) => c.direction === "out").map((c) => c.name));
    hello.outputs.forEach((output, i) => {
      if (!output || !outward.has(output.name)) return;
      const its = output.leaves.flatMap((leaf, at) =>
        leaf.kind === "enum" ? [{ output: i, leaf: at, name: `${output.name}.${leaf.path}`, last: undefined }] : [],
      );
      if (its.length > 0) this.watches.set(i, its);
    });
  }

  add(event: Event): void {
    this.all.push(event);
    if (this.all.length > mostEvents) {
      this.all.shift();
      ++this.dropped;
    }
  }

  addRunEvents(events: readonly RunEvent[]): void {
    for (const event of events) {
      const text = event.kind === "fault" ? `${event.task}: ${event.text} (activation ${event.activation})` : event.text;
      this.add({ t: event.t, kind: event.kind, text, ...(event.task === undefined ? {} : { task: event.task }) });
    }
  }

  look(samples: readonly Sample[]): void {
    for (const [output, t, ...cells] of samples)
      for (const watch of this.watches.get(output) ?? []) {
        const value = cells[watch.leaf];
        if (typeof value !== "number" || value === watch.last) continue;
        if (watch.last !== undefined) this.add({ t, kind: "told", text: this.textOf(watch, value) });
        watch.last = value;
      }
  }

  private textOf(watch: Watch, value: number): string {
    const leaf = this.hello.outputs[watch.output]!.leaves[watch.leaf]!;
    const meaning = leaf.words?.find((word) => word.number === value)?.meaning;
    return `${watch.name} is ${wordOf(leaf, value)}${meaning ? `: ${meaning}` : ""}`;
  }
}

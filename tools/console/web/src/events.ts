// What happened, in words: faults, and what the vehicle's own decisions tell the outside.

import { formatCell, wordOf } from "./format.ts";
import type { Hello, Leaf, RunEvent, Sample } from "./protocol.ts";

export interface Event {
  t: number;
  kind: "fault" | "mishap" | "rest" | "event" | "operator" | "page";
  text: string;
  task?: string; // of a fault
}

export const maxEvents = 1000;

interface Watch {
  output: number;
  leaf: number;
  name: string;
  last: number | undefined;
}

/** What is asked for, by the name that plots have: it is noted once it has stayed for so long. */
interface Asked {
  leaf: number;
  title: string;
  last: number | undefined;
  since: number;
  noted: number | undefined;
}
const settled = 0.5;

/** Notes when something else is asked for, and when an enumeration that goes out changes and either word has a meaning, or is a state. */
export class EventLog {
  readonly all: Event[] = [];
  dropped = 0;
  private readonly hello: Hello;
  private readonly watches: Map<number, Watch[]>;
  private readonly asked = new Map<number, Asked[]>();

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
    hello.outputs.forEach((output, i) => {
      const its = (output?.leaves ?? []).flatMap(({ path, kind }, leaf) => {
        const pair = hello.pairs.find(({ commanded }) => commanded === `${output!.name}.${path}`);
        return pair && kind === "number" ? [{ leaf, title: pair.title, last: undefined, since: 0, noted: undefined }] : [];
      });
      if (its.length > 0) this.asked.set(i, its);
    });
  }

  /** In the order of time, though of several outputs one comes after the other. */
  add(event: Event): void {
    let at = this.all.length;
    while (at > 0 && this.all[at - 1]!.t > event.t) --at;
    this.all.splice(at, 0, event);
    if (this.all.length > maxEvents) {
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
    for (const [output, t, ...cells] of samples) {
      for (const asked of this.asked.get(output) ?? []) this.listen(asked, this.hello.outputs[output]!.leaves[asked.leaf]!, t, cells[asked.leaf]);
      for (const watch of this.watches.get(output) ?? []) {
        const value = cells[watch.leaf];
        if (typeof value !== "number" || value === watch.last) continue;
        if (watch.last !== undefined) this.add({ t, kind: "event", text: this.textOf(watch, value) });
        watch.last = value;
      }
    }
  }

  // a stick that moves is no command until it rests
  private listen(asked: Asked, leaf: Leaf, t: number, value: unknown): void {
    if (typeof value !== "number") return;
    if (value !== asked.last) [asked.last, asked.since] = [value, t];
    if (value === asked.noted || t < asked.since + settled) return;
    const first = asked.noted === undefined;
    asked.noted = value;
    if (!first) this.add({ t: asked.since, kind: "operator", text: `${asked.title} ${formatCell(leaf, value)}` });
  }

  private textOf(watch: Watch, value: number): string {
    const leaf = this.hello.outputs[watch.output]!.leaves[watch.leaf]!;
    const meaning = leaf.words?.find((word) => word.number === value)?.meaning;
    return `${watch.name} is ${wordOf(leaf, value)}${meaning ? `: ${meaning}` : ""}`;
  }
}

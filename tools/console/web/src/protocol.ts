// What the server sends: see tools/console/README.md.

import type { Flow } from "./vehicles.ts";

export interface Word {
  number: number;
  name: string;
  meaning?: string;
}

export interface Leaf {
  path: string;
  unit: string;
  kind: "number" | "bool" | "enum" | "text";
  text?: string;
  words?: Word[];
}

export interface Output {
  name: string;
  type: string;
  kind: "task" | "communicator" | "truth";
  of: string;
  leaves: Leaf[];
}

/** Of a task: what it was given, as text, in the unit. */
export interface Parameter {
  path: string;
  kind: "number" | "integer" | "bool" | "enum" | "text";
  unit: string;
  text?: string;
  value: string;
  default: string;
  words?: string[];
  min?: number;
  max?: number;
}

export interface Task {
  name: string;
  type: string;
  core?: number;
  parameters: Parameter[];
  period: number;
  offset: number;
  deadline: number;
  let?: number;
  wcet?: number;
  slack?: number;
}

export interface Communicator {
  name: string;
  direction: "in" | "out";
  type: string;
  period: number;
  offset: number;
  timeout?: number;
  distributer?: string;
}

export interface Distributer {
  name: string;
  type: string;
  summary: string;
  vehicle: boolean;
  link: string;
  parameters?: Parameter[];
}

export interface Connection {
  from: string;
  to: string;
  type: string;
}

export type Point = [number, number];

export interface DrawnNode {
  kind: "task" | "in" | "out" | "distributer";
  name: string;
  lines: string[];
  x: number;
  y: number;
  width: number;
  height: number;
}

export interface DrawnArrow {
  from: number;
  to: number;
  connections: number[];
  text: string;
  curve: Point[];
}

export interface Drawing {
  width: number;
  height: number;
  core: [number, number, number, number];
  nodes: DrawnNode[];
  arrows: DrawnArrow[];
}

export interface Pair {
  title: string;
  commanded: string;
  reached: string;
}

/** Who has a core when, if each task takes its WCET: [task, begin, end] in seconds; all repeats after a round, the last one. */
export interface Schedule {
  until: number;
  round?: number;
  slices: [number, number, number][];
}

/** An operator who is at this page. */
export interface DeskDescription {
  name: string;
  type: string;
  messages: string;
}

/** What the run was begun with. */
export interface Given {
  file: string;
  profile: string;
  set: string[];
  seed: number;
}

export interface Hello {
  schema: string;
  graph: string;
  file: string;
  clock: "virtual" | "real" | "recorded";
  until?: number;
  given?: Given;
  paced: boolean;
  outputs: (Output | null)[];
  tasks: Task[];
  communicators: Communicator[];
  distributers: Distributer[];
  connections: Connection[];
  pairs: Pair[];
  drawing: Drawing;
  verdict?: { kind: "schedulable" | "not_schedulable" | "unknown"; reason: string };
  schedule?: Schedule;
  desks?: DeskDescription[];
  flow?: Flow;
}

export interface RunEvent {
  t: number;
  kind: "fault" | "rest" | "mishap";
  task?: string;
  activation?: number;
  text: string;
}

export type Cell = number | string | unknown[] | null;
export type Sample = [output: number, t: number, ...cells: Cell[]];

export interface Shown {
  now: number;
  paused?: boolean;
  speed?: number | "max";
  thinned?: number;
  lost_events?: number;
  events?: RunEvent[];
  samples?: Sample[];
  desk?: Record<string, { commander: string | null; why?: string }>;
  answers?: Record<string, Answer[]>;
}

export type Fields = Record<string, unknown>;
/** What an operator's distributer has said: a message of its set. */
export interface Answer {
  message: string;
  fields: Fields;
}

export type Message =
  | { hello: Hello }
  | { missed: number }
  | { error: string }
  | { ended: string }
  | Shown;

export const schema = "jarol.console/1";

/** What can't be understood is said; nothing of it is used. */
export function parseMessage(text: string): Message {
  const message: unknown = JSON.parse(text);
  if (typeof message !== "object" || message === null) throw new Error("expected an object");
  if ("hello" in message) {
    const hello = message.hello as Partial<Hello>;
    if (hello.schema !== schema) throw new Error(`the server speaks ${hello.schema}, the page ${schema}: load it again`);
  } else if (!("missed" in message || "error" in message || "ended" in message || "now" in message)) {
    throw new Error(`the server sent ${Object.keys(message).join(", ")}, which the page does not know`);
  }
  return message as Message;
}

// What comes from jarol on the socket of the editor: tools/commands/edit/README.md.

export interface Field {
  path: string;
  kind: "bool" | "enum" | "integer" | "number" | "duration" | "text" | "list";
  default: string;
  unit?: string;
  text?: string;
  min?: number;
  max?: number;
  words?: { name: string; meaning?: string }[];
}
export interface Port {
  name: string;
  type: string;
  text: string;
}
export interface TaskType {
  name: string;
  summary: string;
  parameters: Field[];
  inputs: Port[];
  outputs: Port[];
}
export interface Channel extends Port {
  direction: "in" | "out";
}
export interface DistributerType {
  name: string;
  summary: string;
  channels: Channel[];
  parameters: Field[];
  links: string[];
}
export interface Key {
  name: string;
  form: string;
  text: string;
  required?: boolean;
  choices?: string[];
}
export interface LinkType {
  name: string;
  summary: string;
  keys: Key[];
}
export interface Catalogue {
  tasks: TaskType[];
  distributers: DistributerType[];
  links: LinkType[];
  types: string[];
  keys: Record<"timing" | "platform" | "distributers" | "communicators" | "tasks", Key[]>;
}
export interface Hello {
  schema: string;
  file: string;
  profile: string;
  catalogue: Catalogue;
}

export interface Place {
  file: string;
  line: number;
  column: number;
  text: string;
}
export interface Problem extends Place {
  notes?: Place[];
}
export interface Checked {
  verdict: string;
  limits_hold: boolean | null; // null: not known
  reason: string;
  utilisation: number;
  tasks: { name: string; slack_ns: number | null; response_ns: number | null; response_exact: boolean | null; core: number | null }[];
  chains: { name: string; holds: boolean | null; max_reaction_ns: number; reaction_limit_ns: number | null }[];
}
export interface Verdict {
  id: number;
  problems: Problem[];
  check?: Checked;
  report?: string;
  took_ms: number;
}

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
  curve: [number, number][];
}
export interface Drawing {
  width: number;
  height: number;
  core: [number, number, number, number];
  nodes: DrawnNode[];
  arrows: DrawnArrow[];
}
export interface Drawn {
  id: number;
  drawing?: Drawing;
  why?: string;
  connections: { from: string; to: string }[];
}

export interface Suggestion {
  text: string;
  set: string[];
}
export interface Version {
  text: string;
  hash: string;
}
export type Trial =
  | { state: "running"; watched: boolean }
  | { state: "watched"; url: string }
  | { state: "ended"; exit_code: number; stopped: boolean; text: string };

export type Message =
  | { hello: Hello }
  | { opened: Version }
  | { verdict: Verdict }
  | { drawn: Drawn }
  | { suggested: { id: number; list: Suggestion[] } }
  | { saved: { hash: string } }
  | { conflict: Version }
  | { unsaved: { why: string } }
  | { disk: { hash: string } }
  | { trial: Trial }
  | { missed: number }
  | { error: string };

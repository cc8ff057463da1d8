// What the text of a graph says: its parts, and where each stands.

import { isMap, isScalar, isSeq, type Node } from "yaml";
import type { Extent } from "./splice.ts";
import { contentEnd, extentOf, isCollection, keyOf, Tree, valueOf, type Path } from "./tree.ts";

export type Kind = "task" | "communicator" | "distributer";
export const kinds: readonly Kind[] = ["distributer", "communicator", "task"];
export type Section = "tasks" | "communicators" | "distributers";
export const sectionOf = (kind: Kind): Section => `${kind}s`;

/** A task, communicator or distributer. */
export interface Part {
  kind: Kind;
  name: string;
  at: Extent;
  path: Path;
}

/** "task.output" or "communicator". */
export interface End {
  name: string;
  field: string;
}
export interface Connection {
  index: number;
  from: End;
  to: End;
  at: Extent;
}

export const endText = ({ name, field }: End): string => (field ? `${name}.${field}` : name);
export const arrowText = (from: End, to: End): string => `${endText(from)} -> ${endText(to)}`;
export const isName = (text: string): boolean => /^[A-Za-z_][A-Za-z0-9_]*$/.test(text);

const end = "([A-Za-z_][A-Za-z0-9_]*)(?:\\.([A-Za-z_][A-Za-z0-9_]*))?";
const arrow = new RegExp(`^[ \\t]*${end}[ \\t]*->[ \\t]*${end}[ \\t]*$`);

export function parseArrow(text: string): { from: End; to: End } | undefined {
  const found = arrow.exec(text);
  if (!found) return undefined;
  return { from: { name: found[1]!, field: found[2] ?? "" }, to: { name: found[3]!, field: found[4] ?? "" } };
}

export class GraphText {
  readonly tree: Tree;
  readonly parts: readonly Part[];
  readonly connections: readonly Connection[];

  readonly text: string;

  constructor(text: string) {
    this.text = text;
    this.tree = new Tree(text);
    this.parts = kinds.flatMap((kind) => this.partsOf(kind));
    this.connections = this.readConnections();
  }

  get isGood(): boolean {
    return this.tree.errors.length === 0 && this.tree.root !== undefined;
  }

  find(kind: Kind, name: string): Part | undefined {
    return this.parts.find((part) => part.kind === kind && part.name === name);
  }
  of(kind: Kind): Part[] {
    return this.parts.filter((part) => part.kind === kind);
  }

  /** Tasks and communicators share their names. */
  owner(name: string): Part | undefined {
    return this.find("task", name) ?? this.find("communicator", name);
  }

  /** A word at a path; undefined: there is none, or no word. */
  word(path: Path): string | undefined {
    const node = this.tree.find(path);
    return node && isScalar(node) && node.range![0] !== node.range![1] ? String(node.value) : undefined;
  }
  /** What stands at a path as it is written; a word without its quotes. */
  written(path: Path): string | undefined {
    const node = this.tree.find(path);
    return node === undefined ? undefined : (this.word(path) ?? this.tree.source(node));
  }
  keysAt(path: Path): string[] {
    const node = path.length === 0 ? this.tree.root : this.tree.find(path);
    return node && isMap(node) ? node.items.map(keyOf) : [];
  }

  private partsOf(kind: Kind): Part[] {
    const section = this.tree.find([sectionOf(kind)]);
    if (!section || !isMap(section)) return [];
    return section.items.map((pair, index) => ({
      kind,
      name: keyOf(pair),
      at: this.extent(section, index),
      path: [sectionOf(kind), keyOf(pair)],
    }));
  }

  private readConnections(): Connection[] {
    const list = this.tree.find(["connections"]);
    if (!list || !isSeq(list)) return [];
    const found: Connection[] = [];
    list.items.forEach((_, index) => {
      const element = valueOf(list, index);
      const ends = element && isScalar(element) ? parseArrow(String(element.value)) : undefined;
      if (ends) found.push({ index, ...ends, at: this.extent(list, index) });
    });
    return found;
  }

  private extent(node: Node, index: number): Extent {
    if (isCollection(node)) {
      try {
        return extentOf(this.text, node, index);
      } catch {
        const value = valueOf(node, index);
        if (value?.range) return { from: value.range[0], to: contentEnd(this.text, value) };
      }
    }
    return { from: 0, to: 0 };
  }

  /** What the place of a problem belongs to; the narrowest. */
  at(offset: number): { part?: Part; connection?: Connection } {
    const within = ({ at }: { at: Extent }): boolean => at.from <= offset && offset <= at.to && at.to > at.from;
    const part = this.parts.find(within);
    if (part) return { part };
    const connection = this.connections.find(within);
    return connection ? { connection } : {};
  }
}

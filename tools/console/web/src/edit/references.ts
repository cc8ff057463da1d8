// Where the text of a graph names a task, communicator or distributer: what is renamed is renamed everywhere.

import { isMap, isScalar, isSeq, type Node } from "yaml";
import { wordText } from "./entries.ts";
import { sectionOf, type GraphText, type Part } from "./graph_text.ts";
import type { Splice } from "./splice.ts";
import { keyOf } from "./tree.ts";

const word = "[A-Za-z0-9_]";

class Renaming {
  readonly splices: Splice[] = [];
  private readonly end: RegExp;
  private readonly condition: RegExp;
  private readonly channel: RegExp;

  private readonly graph: GraphText;
  private readonly part: Part;
  private readonly name: string;

  constructor(graph: GraphText, part: Part, name: string) {
    this.graph = graph;
    this.part = part;
    this.name = name;
    const old = part.name;
    this.end = new RegExp(`(?<![A-Za-z0-9_.])${old}(?!${word})`, "g");
    this.channel = new RegExp(`(?<![A-Za-z0-9_.])${old}(?=\\.)`, "g");
    // of a condition: "depth of dune" is a true value of a distributer, "is ground" an enumerator
    this.condition =
      part.kind === "task"
        ? new RegExp(`(?<![A-Za-z0-9_.])${old}(?=\\.[A-Za-z_])`, "g")
        : part.kind === "communicator"
          ? new RegExp(`(?<![A-Za-z0-9_.]|\\b(?:is|or|not)\\s+)${old}(?!${word}|\\s*\\(|\\s+of\\b)`, "g")
          : new RegExp(`(?<=\\bof\\s+)${old}(?![A-Za-z0-9_.])`, "g");
  }

  private replace(node: Node, pattern: RegExp): void {
    const source = this.graph.text.slice(node.range![0], node.range![1]);
    for (const found of source.matchAll(pattern)) {
      const from = node.range![0] + found.index;
      this.splices.push({ from, to: from + this.part.name.length, insert: this.name });
    }
  }

  /** The key that stands at a path, of which `own` are its own steps: those of a profile have dots. */
  private key(node: Node, path: readonly string[], own: number): void {
    const { part } = this;
    const named =
      (path[0] === sectionOf(part.kind) && path[1] === part.name && path.length - own < 2) ||
      (part.kind === "communicator" && path[0] === "at_end" && path[1] === "command" && path[2] === part.name && path.length - own < 3);
    if (!named || !isScalar(node)) return;
    const step = path[0] === "at_end" ? 2 : 1;
    const steps = path.slice(path.length - own);
    steps[step - (path.length - own)] = this.name;
    this.splices.push({ from: node.range![0], to: node.range![1], insert: wordText(steps.join(".")) });
  }

  visit(node: Node | null, path: readonly string[]): void {
    if (isMap(node)) {
      const dotted = (path.length === 2 && path[0] === "profiles") || (path.length === 2 && path[0] === "campaign" && path[1] === "vary");
      for (const pair of node.items) {
        const own = dotted ? keyOf(pair).split(".") : [keyOf(pair)];
        const all = dotted ? own : [...path, ...own];
        this.key(pair.key as Node, all, own.length);
        this.visit(pair.value as Node | null, all);
      }
    } else if (isSeq(node)) {
      for (const element of node.items) this.visit(element as Node, [...path, "#"]);
    } else if (isScalar(node)) this.word(node, path);
  }

  private word(node: Node, path: readonly string[]): void {
    const inner = this.part.kind !== "distributer";
    const is = (...steps: string[]): boolean =>
      steps.length === path.length && steps.every((step, i) => step === "*" || step === path[i]);
    if (is("expect", "#") || is("at_end", "until") || is("campaign", "metrics", "*")) this.replace(node, this.condition);
    else if (inner && (is("connections", "#") || is("chains", "*", "path", "#"))) this.replace(node, this.end);
    else if (!inner && is("communicators", "*", "channel")) this.replace(node, this.channel);
  }
}

/** The key of a part, and all that names it. */
export function renamingOf(graph: GraphText, part: Part, name: string): Splice[] {
  const renaming = new Renaming(graph, part, name);
  renaming.visit(graph.tree.root ?? null, []);
  return renaming.splices;
}

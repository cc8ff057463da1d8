// A YAML text as a tree whose nodes know where they stand.

import {
  isAlias,
  isMap,
  isPair,
  isScalar,
  isSeq,
  parseDocument,
  visit,
  type Node,
  type Pair,
  type YAMLMap,
  type YAMLSeq,
} from "yaml";
import { CannotEdit, type Extent } from "./splice.ts";

export type Path = readonly (string | number)[];
export type Collection = YAMLMap | YAMLSeq;

export class Tree {
  readonly root: YAMLMap | undefined;
  /** There is nothing in it, or comments alone. */
  readonly isBlank: boolean;
  /** Names of anchors that are used. */
  private readonly used = new Set<string>();
  /** What is wrong with the text as YAML. */
  readonly errors: readonly { at: number; text: string }[];

  readonly text: string;

  constructor(text: string) {
    this.text = text;
    const document = parseDocument(text, { schema: "failsafe", prettyErrors: false, logLevel: "silent" });
    this.errors = document.errors.map((error) => ({ at: error.pos[0], text: error.message }));
    this.root = isMap(document.contents) ? document.contents : undefined;
    this.isBlank = this.errors.length === 0 && isEmpty(document.contents ?? undefined);
    visit(document, { Alias: (_, alias) => void this.used.add(alias.source) });
  }

  /** The value at a path; undefined: there is none. */
  find(path: Path): Node | undefined {
    let node: Node | undefined = this.root;
    for (const step of path) {
      const index = node && isCollection(node) ? indexOf(node, step) : -1;
      if (index < 0) return undefined;
      node = valueOf(node as Collection, index);
    }
    return node;
  }

  /** The anchor of a node, if it is used elsewhere. */
  private usedAnchor(node: Node | undefined): string | undefined {
    const anchor = node && !isAlias(node) ? (node as { anchor?: string }).anchor : undefined;
    return anchor !== undefined && this.used.has(anchor) ? anchor : undefined;
  }

  /** An anchor that is used elsewhere, of what stands at a path or around it: what is added here is added there. */
  anchorAround(path: Path): string | undefined {
    for (let length = path.length; length > 0; --length) {
      const anchor = this.usedAnchor(this.find(path.slice(0, length)));
      if (anchor !== undefined) return anchor;
    }
    return undefined;
  }

  /** The same, or within it: a change here would be one there. */
  anchorOf(path: Path): string | undefined {
    let anchor = this.anchorAround(path);
    const node = this.find(path);
    if (node) visit(node, { Node: (_, its) => void (anchor ??= this.usedAnchor(its)) });
    return anchor;
  }

  /** What stands there, as it is written. */
  source(node: Node): string {
    return this.text.slice(node.range![0], contentEnd(this.text, node));
  }
}

export const isCollection = (node: unknown): node is Collection => isMap(node) || isSeq(node);
export const isFlow = (node: Collection): boolean => node.flow === true;

/** Nothing is written there. */
export const isEmpty = (node: Node | undefined): boolean =>
  node === undefined || (isScalar(node) && node.range![0] === node.range![1]);

export function keyOf(pair: Pair): string {
  return isScalar(pair.key) ? String(pair.key.value) : "";
}

export function indexOf(node: Collection, step: string | number): number {
  if (isMap(node)) return node.items.findIndex((pair) => keyOf(pair) === String(step));
  return typeof step === "number" && step < node.items.length ? step : -1;
}

export function valueOf(node: Collection, index: number): Node | undefined {
  const item = node.items[index];
  return (isPair(item) ? item.value : item) as Node | undefined;
}

/** Where what it says ends: before spaces and comments that follow. */
export function contentEnd(text: string, node: Node): number {
  if (isCollection(node) && !isFlow(node) && node.items.length > 0) return extentOf(text, node, node.items.length - 1).to;
  let end = node.range![1];
  if (isScalar(node) && (node.type === "BLOCK_LITERAL" || node.type === "BLOCK_FOLDED"))
    while (end > node.range![0] && /\s/.test(text[end - 1]!)) --end;
  return end;
}

/** An entry of a mapping from its key on, or an element of a list without its dash. */
export function extentOf(text: string, node: Collection, index: number): Extent {
  const item = node.items[index]!;
  if (!isPair(item)) {
    const element = item as Node;
    if (isScalar(element) || isCollection(element)) refuseAnchor(element.anchor);
    return { from: element.range![0], to: contentEnd(text, element) };
  }
  const key = item.key as Node | null;
  if (!key || !isScalar(key) || !key.range) throw new CannotEdit("a key that is no word is edited in the text only");
  const value = item.value as Node | null;
  if (value && (isScalar(value) || isCollection(value))) refuseAnchor(value.anchor);
  const from = key.range[0];
  if (value?.range && (!isEmpty(value) || isAlias(value))) return { from, to: contentEnd(text, value) };
  // a key alone ends with its colon, or within {} without one
  const colon = text.indexOf(":", key.range[1]);
  const bare = colon < 0 || /\S/.test(text.slice(key.range[1], colon));
  return { from, to: bare ? key.range[1] : colon + 1 };
}

function refuseAnchor(anchor: string | undefined): void {
  if (anchor) throw new CannotEdit(`what has the anchor '&${anchor}' is edited in the text only`);
}

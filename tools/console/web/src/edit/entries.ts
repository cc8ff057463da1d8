// Entries of mappings and lists, put in, taken out and changed in the style in which they are written: each returns the
// splices that do it.

import { isAlias, isMap, isScalar, isSeq, type Node, type Scalar } from "yaml";
import {
  CannotEdit,
  commentsOf,
  lineEnd,
  lineStart,
  newLineOf,
  nextLine,
  type Comment,
  type Extent,
  type Splice,
} from "./splice.ts";
import { contentEnd, extentOf, indexOf, isCollection, isEmpty, isFlow, type Collection, type Path, type Tree } from "./tree.ts";

const blank = (text: string): boolean => /^[ \t\r\n]*$/.test(text);

/** A word as it may stand anywhere, in quotes where it must. */
export function wordText(word: string): string {
  const plain =
    /^[^\s\-?:,[\]{}#&*!|>'"%@`]([^\n\r\t:#,[\]{}]|:(?=[^\s,[\]{}])|#(?<=\S#))*$/.test(word) && word === word.trim();
  const dashed = /^-[^\s,[\]{}#:]+$/.test(word);
  return plain || dashed ? word : JSON.stringify(word);
}

const commentsIn = (text: string, { from, to }: Extent): Comment[] =>
  commentsOf(text).filter((comment) => comment.from >= from && comment.to <= to);

/** Where the entry begins on its line: an element of a block list at its dash. */
function beginOf(text: string, node: Collection, index: number): number {
  const { from } = extentOf(text, node, index);
  if (isMap(node) || isFlow(node)) return from;
  const dash = text.lastIndexOf("-", from - 1);
  if (dash < 0 || !blank(text.slice(dash + 1, from))) throw new CannotEdit("this list is edited in the text only");
  return dash;
}

const beginsLine = (text: string, at: number): boolean => blank(text.slice(lineStart(text, at), at));
const indentAt = (text: string, at: number): string => " ".repeat(at - lineStart(text, at));

/** The comma behind an element of a flow collection, over spaces and comments; undefined: there is none. */
function commaAfter(text: string, at: number, end: number): number | undefined {
  const comments = commentsOf(text);
  for (let i = at; i < end; ++i) {
    const comment = comments.find(({ from, to }) => from <= i && i < to);
    if (comment) i = comment.to - 1;
    else if (text[i] === ",") return i;
    else if (!/\s/.test(text[i]!)) return undefined;
  }
  return undefined;
}

/** Puts in one more entry behind that of the index; -1: before all. `entry` is as in "key: value", without a dash. */
export function insertEntry(tree: Tree, node: Collection, entry: string, after = node.items.length - 1): Splice[] {
  const { text } = tree;
  const put = (at: number, insert: string): Splice => ({ from: at, to: at, insert });
  const dash = isSeq(node) && !isFlow(node) ? "- " : "";
  if (node.items.length === 0) return [put(node.range![0] + 1, entry)];
  if (after < 0) {
    const at = beginOf(text, node, 0);
    if (isFlow(node)) return [put(at, `${entry}, `)];
    return [put(at, `${dash}${entry}${newLineOf(text)}${indentAt(text, at)}`)];
  }
  const own = extentOf(text, node, after);
  if (!isFlow(node)) {
    const indent = indentAt(text, beginOf(text, node, 0));
    return [put(lineEnd(text, own.to), `${newLineOf(text)}${indent}${dash}${entry}`)];
  }
  // one to a line stays so
  const before = after > 0 ? extentOf(text, node, after - 1).to : node.range![0] + 1;
  if (!text.slice(before, own.from).includes("\n") || !beginsLine(text, own.from))
    return [put(own.to, `, ${entry}`)];
  const line = `${newLineOf(text)}${text.slice(lineStart(text, own.from), own.from)}${entry}`;
  const end = lineEnd(text, own.to);
  const comma = commaAfter(text, own.to, node.range![1]);
  const rest = text.slice(own.to, end);
  if (!/^\s*,?\s*(#.*)?$/.test(rest)) return [put(own.to, `,${line}`)];
  if (comma !== undefined) return [put(end, `${line},`)];
  return [put(own.to, ","), put(end, line)];
}

/** Takes an entry out; comments stay, a line each. */
export function removeEntry(tree: Tree, node: Collection, index: number): Splice[] {
  return isFlow(node) ? removeFromFlow(tree.text, node, index) : removeLines(tree.text, node, index);
}

function removeFromFlow(text: string, node: Collection, index: number): Splice[] {
  const own = extentOf(text, node, index);
  const end = node.range![1];
  const last = index === node.items.length - 1;
  const comma = commaAfter(text, own.to, end);
  if (!last) {
    const all = { from: own.from, to: extentOf(text, node, index + 1).from };
    if (commentsIn(text, all).length === 0) return [{ ...all, insert: "" }];
  } else if (index > 0) {
    const all = { from: extentOf(text, node, index - 1).to, to: own.to };
    if (commentsIn(text, all).length === 0 && commentsIn(text, own).length === 0) return [{ ...all, insert: "" }];
  }
  const within = commentsIn(text, own);
  if (within.length > 0) throw new CannotEdit("this has comments within its brackets; take it out in the text");
  const splices: Splice[] = [];
  if (comma !== undefined && blank(text.slice(own.to, comma))) splices.push({ from: own.from, to: comma + 1, insert: "" });
  else {
    splices.push({ ...own, insert: "" });
    if (comma !== undefined) splices.push({ from: comma, to: comma + 1, insert: "" });
  }
  // no line is left empty, nor a space before what follows on it
  const first = splices[0]!;
  const rest = /^[ \t]*/.exec(text.slice(first.to))![0].length;
  if (beginsLine(text, first.from) && blank(text.slice(first.to, lineEnd(text, first.to)))) {
    first.from = lineStart(text, first.from);
    first.to = nextLine(text, first.to);
  } else if (beginsLine(text, first.from)) first.to += rest;
  return splices;
}

function removeLines(text: string, node: Collection, index: number): Splice[] {
  const own = extentOf(text, node, index);
  const begin = beginOf(text, node, index);
  if (!beginsLine(text, begin)) {
    // the first of a mapping that begins behind a dash
    if (node.items.length < 2) throw new CannotEdit("this is the only entry; take out what holds it");
    const all = { from: begin, to: beginOf(text, node, index + 1) };
    if (commentsIn(text, all).length > 0) throw new CannotEdit("there are comments between; take it out in the text");
    return [{ ...all, insert: "" }];
  }
  const all = { from: lineStart(text, begin), to: nextLine(text, own.to) };
  const indent = indentAt(text, begin);
  const kept = commentsIn(text, { from: all.from, to: lineEnd(text, own.to) });
  return [{ ...all, insert: kept.map((comment) => indent + comment.text + newLineOf(text)).join("") }];
}

/** Changes places with the entry before (-1) or behind (1). Comments right above an entry of its own lines go with it. */
export function moveEntry(tree: Tree, node: Collection, index: number, by: -1 | 1): Splice[] {
  const { text } = tree;
  const upper = Math.min(index, index + by);
  if (upper < 0 || upper + 1 >= node.items.length) throw new CannotEdit("there is nothing to change places with");
  const extents = [upper, upper + 1].map((i) => (isFlow(node) ? extentOf(text, node, i) : linesOf(text, node, i)));
  const [one, two] = extents as [Extent, Extent];
  const [first, second] = [text.slice(one.from, one.to), text.slice(two.from, two.to)];
  return [
    { ...one, insert: second },
    { ...two, insert: first },
  ];
}

function linesOf(text: string, node: Collection, index: number): Extent {
  const begin = beginOf(text, node, index);
  if (!beginsLine(text, begin)) throw new CannotEdit("what begins behind a dash is moved in the text only");
  let from = lineStart(text, begin);
  const above = index > 0 ? nextLine(text, extentOf(text, node, index - 1).to) : from;
  const comment = indentAt(text, begin) + "#";
  while (from > above && text.startsWith(comment, lineStart(text, from - 1))) from = lineStart(text, from - 1);
  return { from, to: lineEnd(text, extentOf(text, node, index).to) };
}

/** Another value in its place; a word in quotes keeps its quotes. */
export function replaceValue(tree: Tree, node: Node, value: string): Splice[] {
  const { text } = tree;
  const from = node.range![0];
  if (isEmpty(node) && !isAlias(node)) return [{ from, to: from, insert: / $/.test(text.slice(0, from)) ? value : ` ${value}` }];
  if (isScalar(node) && /^[\w.%/:-][\w.%/: -]*$/.test(value)) {
    const quote = node.type === "QUOTE_SINGLE" ? "'" : node.type === "QUOTE_DOUBLE" ? '"' : "";
    value = quote + value + quote;
  }
  const block = isCollection(node) && !isFlow(node);
  const all = { from, to: contentEnd(text, node) };
  if (commentsIn(text, all).length > 0) throw new CannotEdit("there are comments in what stands there; change it in the text");
  if (!block) return [{ ...all, insert: value }];
  // below its key
  const colon = text.lastIndexOf(":", from - 1);
  if (colon < 0 || !blank(text.slice(colon + 1, from)))
    throw new CannotEdit("there are comments before what stands there; change it in the text");
  return [{ from: colon + 1, to: all.to, insert: ` ${value}` }];
}

/** Sets the value at a path of mappings, of which those at the end may be new; `order` says behind which keys a new one
 * stands. */
export function setAt(tree: Tree, path: Path, value: string, order: readonly string[] = []): Splice[] {
  for (let depth = path.length; depth >= 0; --depth) {
    const node = depth === 0 ? tree.root : tree.find(path.slice(0, depth));
    if (node === undefined) continue;
    if (depth === path.length) return replaceValue(tree, node, value);
    const rest = path.slice(depth + 1).map((step) => wordText(String(step)));
    const nested = rest.reduceRight((inner, key) => `{${key}: ${inner}}`, value);
    const key = String(path[depth]);
    const entry = `${wordText(key)}: ${nested}`;
    if (isMap(node)) {
      const place = order.indexOf(key);
      let after = node.items.length - 1;
      if (place >= 0)
        for (after = node.items.length - 1; after >= 0; --after) {
          const at = order.indexOf(String((node.items[after]!.key as Scalar).value));
          if (at >= 0 && at < place) break;
        }
      return insertEntry(tree, node, entry, after);
    }
    if (isEmpty(node)) return replaceValue(tree, node, `{${entry}}`);
    throw new CannotEdit(`'${path.slice(0, depth).join(".")}' is no mapping that could hold '${key}'`);
  }
  throw new CannotEdit("there is no graph in the text");
}

/** Takes out what stands at a path; a mapping within an entry goes with its last key. */
export function removeAt(tree: Tree, path: Path): Splice[] {
  const parent = tree.find(path.slice(0, -1));
  if (!parent || !isCollection(parent)) return [];
  const index = indexOf(parent, path[path.length - 1]!);
  if (index < 0) return [];
  if (parent.items.length === 1 && path.length > 3) return removeAt(tree, path.slice(0, -1));
  return removeEntry(tree, parent, index);
}

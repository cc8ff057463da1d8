// What people do to a graph: each makes of its text another one, in which nothing else has changed. An edit that would
// break the text, or lose a comment, is not made.

import { isMap, isScalar, isSeq } from "yaml";
import { insertEntry, moveEntry, removeAt, removeEntry, replaceValue, setAt, wordText } from "./entries.ts";
import { arrowText, GraphText, isName, sectionOf, type Connection, type End, type Kind, type Part, type Section } from "./graph_text.ts";
import { renamingOf } from "./references.ts";
import { applySplices, CannotEdit, commentsOf, lineEnd, lineStart, newLineOf, type Splice } from "./splice.ts";
import { contentEnd, extentOf, indexOf, isCollection, isEmpty, isFlow, keyOf, type Path } from "./tree.ts";

/** Sections as files have them in order. */
export const sectionOrder = [
  "graph", "timing", "plugins", "distributers", "communicators", "tasks", "connections", "chains", "platform",
  "fault_limit", "expect", "at_end", "campaign", "profiles",
] as const;

function requireGood(graph: GraphText): void {
  if (!graph.isGood)
    throw new CannotEdit("the text is no YAML as it stands; mend that in the text first, or undo");
}

/** Makes splices of a text, and looks whether all is well. */
function edited(graph: GraphText, splices: readonly Splice[]): GraphText {
  const made = new GraphText(applySplices(graph.text, splices));
  if (!made.isGood) throw new CannotEdit("this can't be done as the text is written; change it in the text");
  const words = (text: string): string => commentsOf(text).map((comment) => comment.text).sort().join("\n");
  if (words(made.text) !== words(graph.text)) throw new CannotEdit("this would lose a comment; change it in the text");
  return made;
}

/** What is changed there changes nothing elsewhere. */
function requireUnused(anchor: string | undefined): void {
  if (anchor !== undefined)
    throw new CannotEdit(`what stands there is used elsewhere, too, as '*${anchor}'; change it in the text`);
}

const orderOf = (keys: readonly string[] | undefined): readonly string[] => keys ?? [];

/** Puts an entry at the end of a section, which is made where there is none. */
function addToSection(graph: GraphText, section: Section | "connections" | "chains", entry: string): GraphText {
  if (graph.tree.isBlank) {
    const begin = graph.text === "" || graph.text.endsWith("\n") ? graph.text : graph.text + newLineOf(graph.text);
    const line = newLineOf(graph.text);
    const made = new GraphText(`${begin}${section}:${line}  ${section === "connections" ? "- " : ""}${entry}${line}`);
    if (!made.isGood) throw new CannotEdit("this can't be done as the text is written; change it in the text");
    return made;
  }
  requireGood(graph);
  const { tree, text } = graph;
  const root = tree.root!;
  requireUnused(tree.anchorAround([section]));
  const node = tree.find([section]);
  const line = newLineOf(text);
  const isList = section === "connections";
  const own = `  ${isList ? "- " : ""}${entry}`;
  if (node && isCollection(node)) return edited(graph, insertEntry(tree, node, entry));
  if (node && !isEmpty(node)) throw new CannotEdit(`'${section}' holds no ${isList ? "list" : "entries"}`);
  if (node) {
    const at = lineEnd(text, extentOf(text, root, indexOf(root, section)).to);
    return edited(graph, [{ from: at, to: at, insert: line + own }]);
  }
  if (isFlow(root)) return edited(graph, insertEntry(tree, root, isList ? `${section}: [${entry}]` : `${section}: {${entry}}`));
  // behind the last section that stands before it in other files, apart as the others are
  const place = (sectionOrder as readonly string[]).indexOf(section);
  let before = -1;
  root.items.forEach((pair, i) => {
    const at = (sectionOrder as readonly string[]).indexOf(keyOf(pair));
    if (at >= 0 && at < place) before = i;
  });
  if (before < 0) before = root.items.length - 1;
  const end = contentEnd(text, root);
  const apart = /\n[ \t]*\r?\n/.test(text.slice(0, end)) ? line : "";
  const at = lineEnd(text, extentOf(text, root, before).to);
  return edited(graph, [{ from: at, to: at, insert: `${line}${apart}${section}:${line}${own}` }]);
}

/** Spaces behind a key, so that values stand below each other where they did. */
function padding(graph: GraphText, section: Section, name: string): string {
  const node = graph.tree.find([section]);
  if (!node || !isMap(node) || isFlow(node)) return " ";
  const last = node.items[node.items.length - 1];
  const value = last?.value;
  if (!last || !value || !(isScalar(value) || isCollection(value)) || (isCollection(value) && !isFlow(value))) return " ";
  const begin = (last.key as { range: number[] }).range[0]!;
  if (lineStart(graph.text, begin) !== lineStart(graph.text, value.range![0])) return " ";
  return " ".repeat(Math.max(1, value.range![0] - begin - wordText(name).length - 1));
}

export function requireNewName(graph: GraphText, kind: Kind, name: string): void {
  if (!isName(name)) throw new CannotEdit(`'${name}' is no name; use letters, digits and _, no digit first`);
  const other = kind === "distributer" ? graph.find("distributer", name) : graph.owner(name);
  if (other) throw new CannotEdit(`there is a ${other.kind} '${name}'; choose another name`);
}

/** A name that is not there yet, made of a word. */
export function freeName(graph: GraphText, kind: Kind, word: string): string {
  const base =
    word
      .replace(/([a-z0-9])([A-Z])/g, "$1_$2")
      .replace(/[^A-Za-z0-9_]/g, "_")
      .toLowerCase()
      .replace(/^(\d)/, "_$1") || kind;
  const taken = (name: string): boolean =>
    kind === "distributer" ? graph.find("distributer", name) !== undefined : graph.owner(name) !== undefined;
  for (let i = 1; ; ++i) {
    const name = i === 1 ? base : `${base}_${i}`;
    if (!taken(name)) return name;
  }
}

/** A new entry with these keys, each with its value as it is to be written. */
export function addPart(graph: GraphText, kind: Kind, name: string, keys: readonly (readonly [string, string])[]): GraphText {
  requireNewName(graph, kind, name);
  const section = sectionOf(kind);
  const body = keys.map(([key, value]) => `${key}: ${value}`).join(", ");
  return addToSection(graph, section, `${wordText(name)}:${padding(graph, section, name)}{${body}}`);
}

/** With all connections of it. */
export function removePart(graph: GraphText, part: Part): GraphText {
  requireGood(graph);
  let made = graph;
  if (part.kind !== "distributer")
    for (const touches = (c: Connection): boolean => c.from.name === part.name || c.to.name === part.name; ; ) {
      const connection = made.connections.find(touches);
      if (!connection) break;
      made = removeConnection(made, connection);
    }
  requireUnused(made.tree.anchorOf(part.path));
  return edited(made, removeAt(made.tree, part.path));
}

/** Everywhere it is named. */
export function renamePart(graph: GraphText, part: Part, name: string): GraphText {
  requireGood(graph);
  if (name === part.name) return graph;
  requireNewName(graph, part.kind, name);
  return edited(graph, renamingOf(graph, part, name));
}

export function connect(graph: GraphText, from: End, to: End): GraphText {
  const text = arrowText(from, to);
  if (graph.connections.some((c) => arrowText(c.from, c.to) === text)) throw new CannotEdit(`there is ${text}`);
  return addToSection(graph, "connections", text);
}

export function removeConnection(graph: GraphText, connection: Connection): GraphText {
  requireGood(graph);
  const list = graph.tree.find(["connections"]);
  if (!list || !isSeq(list)) throw new CannotEdit("there are no connections");
  requireUnused(graph.tree.anchorOf(["connections", connection.index]));
  return edited(graph, removeEntry(graph.tree, list, connection.index));
}

/** Other ends for a connection, in its place. */
export function reconnect(graph: GraphText, connection: Connection, from: End, to: End): GraphText {
  requireGood(graph);
  const text = arrowText(from, to);
  if (graph.connections.some((c) => c.index !== connection.index && arrowText(c.from, c.to) === text))
    throw new CannotEdit(`there is ${text}`);
  requireUnused(graph.tree.anchorOf(["connections", connection.index]));
  return edited(graph, replaceValue(graph.tree, graph.tree.find(["connections", connection.index])!, text));
}

/** Sets a value, or takes the key out: `value` as it is to be written. */
export function setValue(graph: GraphText, path: Path, value: string | undefined, order?: readonly string[]): GraphText {
  requireGood(graph);
  if (graph.written(path) === value) return graph;
  requireUnused(graph.tree.anchorOf(path));
  if (value === undefined) return edited(graph, removeAt(graph.tree, path));
  // a new section stands where others have it
  const keys = path.length === 1 || graph.tree.find(path.slice(0, 1)) === undefined ? sectionOrder : orderOf(order);
  return edited(graph, setAt(graph.tree, path, value, keys));
}

/** What `check` suggests, as --set takes it: "tasks.depth.offset=5ms"; null takes a key out. */
export function takeSuggestion(graph: GraphText, set: readonly string[], orders: Record<string, readonly string[]> = {}): GraphText {
  return set.reduce((made, change) => {
    const at = change.indexOf("=");
    const path = change.slice(0, at).split(".");
    const value = change.slice(at + 1);
    return setValue(made, path, value === "null" ? undefined : wordText(value), orders[path[0]!]);
  }, graph);
}

/** What the loader means instead of a word: "'perid' ... did you mean 'period'?", where that word stands at the place. */
export function meantBy(graph: GraphText, problem: string, offset: number): { from: number; word: string; meant: string } | undefined {
  const meant = /; did you mean '([^']+)'\?/.exec(problem);
  if (!meant) return undefined;
  const words = [...problem.slice(0, meant.index).matchAll(/'([^']+)'/g)].map((found) => found[1]!);
  // the last word that is said stands at the place, in quotes or behind a dot of its connection
  const word = words.pop()!;
  const end = lineEnd(graph.text, offset);
  const from = graph.text.slice(offset, end).search(new RegExp(`(?<![A-Za-z0-9_])${word.replace(/[^A-Za-z0-9_]/g, "\\$&")}(?![A-Za-z0-9_])`));
  return from < 0 ? undefined : { from: offset + from, word, meant: meant[1]! };
}

export function takeMeant(graph: GraphText, { from, word, meant }: { from: number; word: string; meant: string }): GraphText {
  return new GraphText(applySplices(graph.text, [{ from, to: from + word.length, insert: meant }]));
}

/** One place up or down among its like; what a graph means does not change. */
export function movePart(graph: GraphText, part: Part, by: -1 | 1): GraphText {
  requireGood(graph);
  const section = graph.tree.find([sectionOf(part.kind)]);
  if (!section || !isMap(section)) throw new CannotEdit("there is no such section");
  return edited(graph, moveEntry(graph.tree, section, indexOf(section, part.name), by));
}

export function moveConnection(graph: GraphText, connection: Connection, by: -1 | 1): GraphText {
  requireGood(graph);
  const list = graph.tree.find(["connections"]);
  if (!list || !isSeq(list)) throw new CannotEdit("there are no connections");
  return edited(graph, moveEntry(graph.tree, list, connection.index, by));
}

/** A word typed into a form, as it is to be written: of a mapping or list as it stands, checked to be whole. */
export function writtenOf(text: string, structured: boolean): string {
  const trimmed = text.trim();
  if (!structured) return wordText(trimmed);
  const whole = new GraphText(`value: [${trimmed}\n]\n`);
  const list = whole.tree.find(["value"]);
  if (!whole.isGood || !list || !isSeq(list) || list.items.length !== 1 || commentsOf(whole.text).length > 0 || trimmed.includes("\n"))
    throw new CannotEdit(`'${trimmed}' is no value; write a number or word, {key: value} or [1, 2]`);
  return trimmed;
}


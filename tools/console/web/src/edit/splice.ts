// Changes of a text: small pieces that are put in the place of others, so that all else stays as it was.

import { Lexer } from "yaml";

export interface Extent {
  from: number;
  to: number;
}
export interface Splice extends Extent {
  insert: string;
}

/** An edit that can't be made on the text as it is written; people make it by hand. */
export class CannotEdit extends Error {}

/** Splices that do not overlap, in any order. */
export function applySplices(text: string, splices: readonly Splice[]): string {
  const sorted = [...splices].sort((a, b) => a.from - b.from || a.to - b.to);
  let made = "";
  let at = 0;
  for (const { from, to, insert } of sorted) {
    if (from < at || to < from || to > text.length) throw new Error("splices overlap or lie beyond the text");
    made += text.slice(at, from) + insert;
    at = to;
  }
  return made + text.slice(at);
}

export const lineStart = (text: string, at: number): number => text.lastIndexOf("\n", at - 1) + 1;

/** Before the end of the line, whatever that is. */
export function lineEnd(text: string, at: number): number {
  const end = text.indexOf("\n", at);
  if (end < 0) return text.length;
  return end > at && text[end - 1] === "\r" ? end - 1 : end;
}

/** Where the next line begins. */
export function nextLine(text: string, at: number): number {
  const end = text.indexOf("\n", at);
  return end < 0 ? text.length : end + 1;
}

export const newLineOf = (text: string): string => (text.includes("\r\n") ? "\r\n" : "\n");

/** Line and column, from 1, columns in bytes of UTF-8 as the loader counts them. */
export function offsetAt(text: string, line: number, column: number): number {
  let at = 0;
  for (let i = 1; i < line; ++i) {
    const end = text.indexOf("\n", at);
    if (end < 0) return text.length;
    at = end + 1;
  }
  const end = lineEnd(text, at);
  for (let bytes = 1; bytes < column && at < end; ) {
    const code = text.codePointAt(at)!;
    bytes += code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
    at += code < 0x10000 ? 1 : 2;
  }
  return Math.min(at, end);
}

/** Counted from 1. */
export function lineAt(text: string, at: number): number {
  let line = 1;
  for (let i = text.indexOf("\n"); i >= 0 && i < at; i = text.indexOf("\n", i + 1)) ++line;
  return line;
}

export interface Comment extends Extent {
  text: string;
}

// of the texts that were asked about last
const lexed = new Map<string, Comment[]>();

/** All comments, in order. */
export function commentsOf(text: string): Comment[] {
  const known = lexed.get(text);
  if (known) return known;
  const comments: Comment[] = [];
  let at = text.startsWith("\ufeff") ? 1 : 0;
  for (const lexeme of new Lexer().lex(text)) {
    // marks of the lexer itself
    if (lexeme === "\x02" || lexeme === "\x18" || lexeme === "\x1f" || lexeme === "\ufeff") continue;
    if (lexeme.startsWith("#")) comments.push({ from: at, to: at + lexeme.length, text: lexeme.trimEnd() });
    at += lexeme.length;
  }
  if (lexed.size > 7) lexed.delete(lexed.keys().next().value!);
  lexed.set(text, comments);
  return comments;
}

/** What differs between two texts, as one splice of the first; none: nothing. */
export function differenceOf(before: string, after: string): Splice | undefined {
  if (before === after) return undefined;
  let from = 0;
  const min = Math.min(before.length, after.length);
  while (from < min && before[from] === after[from]) ++from;
  let end = 0;
  while (end < min - from && before[before.length - 1 - end] === after[after.length - 1 - end]) ++end;
  return { from, to: before.length - end, insert: after.slice(from, after.length - end) };
}

// A carriage return alone ends no line, neither for the loader nor for YAML here; a browser would make it one that does.
const loneReturn = /\r(?!\n)/g;
const shownReturn = "\u240d";

/** The text as a browser shows it: all ends of lines are \n, and what looks like one and is none is a sign. */
export const shownOf = (text: string): string => text.replace(loneReturn, shownReturn).replaceAll("\r\n", "\n");

/** The place in the text of one in what is shown of it. */
export function placeOf(text: string, shownAt: number): number {
  let place = 0;
  for (let i = 0; i < shownAt; ++i) place += text.startsWith("\r\n", place) ? 2 : 1;
  return place;
}

/** What was typed where the text is shown, as a change of the text. */
export function typed(text: string, value: string): string {
  const change = differenceOf(shownOf(text), value);
  if (!change) return text;
  let { insert } = change;
  if (text.includes("\r\n")) insert = insert.replaceAll("\n", "\r\n");
  // a piece that was moved or copied
  if (text.search(loneReturn) >= 0) insert = insert.replaceAll(shownReturn, "\r");
  return applySplices(text, [{ from: placeOf(text, change.from), to: placeOf(text, change.to), insert }]);
}

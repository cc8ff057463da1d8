// Where the problems of a text are drawn.

import type { GraphText } from "./graph_text.ts";
import type { Problem } from "./protocol.ts";
import { offsetAt } from "./splice.ts";

/** A problem with where it is drawn. */
export interface Finding {
  problem: Problem;
  /** Of the file that is edited; undefined: another one. */
  offset?: number;
  part?: string;
  connection?: number;
}

/** `file`: that is edited, of which `graph` is the text. */
export function findingOf(problem: Problem, graph: GraphText, file: string | undefined): Finding {
  if (problem.file !== file || problem.line < 1) return { problem };
  const offset = offsetAt(graph.text, problem.line, problem.column);
  const { part, connection } = graph.at(offset);
  return {
    problem,
    offset,
    ...(part ? { part: `${part.kind} ${part.name}` } : {}),
    ...(connection ? { connection: graph.connections.indexOf(connection) } : {}),
  };
}

// What can be connected with what: the ends of a graph's tasks and communicators, with their types.

import { endText, type Connection, type End, type GraphText, type Part } from "./graph_text.ts";
import type { Catalogue } from "./protocol.ts";

export interface TypedEnd extends End {
  /** Empty: it is not known. */
  type: string;
  text: string;
}

function channelOf(graph: GraphText, catalogue: Catalogue, part: Part): { direction: string; type: string; text: string } | undefined {
  const [of, name] = (graph.word([...part.path, "channel"]) ?? "").split(".");
  const type = graph.word(["distributers", of ?? "", "type"]);
  return catalogue.distributers.find((d) => d.name === type)?.channels.find((c) => c.name === name);
}

/** "in" or "out"; undefined: it does not say. */
export function directionOf(graph: GraphText, catalogue: Catalogue, part: Part): string | undefined {
  return channelOf(graph, catalogue, part)?.direction ?? graph.word([...part.path, "direction"]);
}

function endsOf(graph: GraphText, catalogue: Catalogue, part: Part, reads: boolean): TypedEnd[] {
  if (part.kind === "task") {
    const type = catalogue.tasks.find((t) => t.name === graph.word([...part.path, "type"]));
    return ((reads ? type?.inputs : type?.outputs) ?? []).map((port) => ({ name: part.name, field: port.name, type: port.type, text: port.text }));
  }
  if (part.kind !== "communicator") return [];
  const direction = directionOf(graph, catalogue, part);
  if (direction !== undefined && (direction === "out") !== reads) return [];
  const channel = channelOf(graph, catalogue, part);
  return [{ name: part.name, field: "", type: channel?.type ?? graph.word([...part.path, "type"]) ?? "", text: channel?.text ?? "" }];
}

/** What a part reads. */
export const inputsOf = (graph: GraphText, catalogue: Catalogue, part: Part): TypedEnd[] => endsOf(graph, catalogue, part, true);
/** What a part gives. */
export const outputsOf = (graph: GraphText, catalogue: Catalogue, part: Part): TypedEnd[] => endsOf(graph, catalogue, part, false);

export const fits = (from: TypedEnd, to: TypedEnd): boolean => from.type === "" || to.type === "" || from.type === to.type;

export const writerOf = (graph: GraphText, to: End): Connection | undefined =>
  graph.connections.find((c) => endText(c.to) === endText(to));
export const readersOf = (graph: GraphText, from: End): Connection[] =>
  graph.connections.filter((c) => endText(c.from) === endText(from));

/** All that an input could read. */
export function sourcesFor(graph: GraphText, catalogue: Catalogue, to: TypedEnd): TypedEnd[] {
  return graph.parts.flatMap((part) => outputsOf(graph, catalogue, part)).filter((from) => fits(from, to));
}
/** All that could read an output. */
export function readersFor(graph: GraphText, catalogue: Catalogue, from: TypedEnd): TypedEnd[] {
  return graph.parts.flatMap((part) => inputsOf(graph, catalogue, part)).filter((to) => fits(from, to));
}

/** The ways to connect two parts, those to open inputs first. */
export function waysBetween(graph: GraphText, catalogue: Catalogue, from: Part, to: Part): { from: TypedEnd; to: TypedEnd; taken: boolean }[] {
  const ways = outputsOf(graph, catalogue, from).flatMap((output) =>
    inputsOf(graph, catalogue, to)
      .filter((input) => fits(output, input))
      .map((input) => ({ from: output, to: input, taken: writerOf(graph, input) !== undefined })),
  );
  return [...ways.filter((way) => !way.taken), ...ways.filter((way) => way.taken)];
}

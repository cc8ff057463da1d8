// Random edits of a graph, with what each is to do to the graph said in another way: on plain objects.
import assert from "node:assert/strict";
import { parse } from "yaml";
import { endText, GraphText, sectionOf, type Kind, type Part } from "../src/edit/graph_text.ts";
import * as operations from "../src/edit/operations.ts";
import { CannotEdit } from "../src/edit/splice.ts";

/** As the numbers of a seed. */
export function randomOf(seed: number): (below: number) => number {
  let state = seed >>> 0;
  return (below) => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return Math.floor((((t ^ (t >>> 14)) >>> 0) / 4294967296) * below);
  };
}

type Entry = Record<string, unknown>;
interface Plain {
  tasks: Record<string, Entry>;
  communicators: Record<string, Entry>;
  distributers: Record<string, Entry>;
  connections: string[];
}

/** What a text says, read by another way than the editor's. */
export function plainOf(text: string): Plain {
  const all = parse(text, { schema: "failsafe" }) as Record<string, unknown>;
  const section = (name: string): Record<string, Entry> => ({ ...((all[name] as Record<string, Entry> | null | "") || {}) });
  return {
    tasks: section("tasks"),
    communicators: section("communicators"),
    distributers: section("distributers"),
    connections: [...((all["connections"] as string[] | null | "") || [])],
  };
}

export interface Edit {
  label: string;
  graph: GraphText;
  expected: Plain;
}

/** Some edit of the graph; undefined: the one that was drawn can't be made. */
export function randomEdit(graph: GraphText, random: (below: number) => number): Edit | undefined {
  const pick = <T>(list: readonly T[]): T => list[random(list.length)]!;
  const expected = plainOf(graph.text);
  const { parts, connections } = graph;
  const done = (label: string, made: GraphText): Edit => ({ label, graph: made, expected });
  const tasks = graph.of("task");
  const rename = (text: string, old: string, name: string): string =>
    text
      .split("->")
      .map((end) => (end.trim().split(".")[0] === old ? end.replace(old, name) : end))
      .join("->");
  try {
    // of a graph that has grown large something is taken out
    const kind = parts.length > 34 ? 3 : random(14);
    if (kind < 2 && tasks.length > 0) {
      // one more of a type, which reads what the other reads
      const model = pick(tasks);
      const type = graph.word([...model.path, "type"])!;
      const name = operations.freeName(graph, "task", type);
      const keys: [string, string][] = [["type", type]];
      for (const key of ["period", "let", "wcet"]) {
        const value = graph.word([...model.path, key]);
        if (value !== undefined) keys.push([key, value]);
      }
      let made = operations.addPart(graph, "task", name, keys);
      expected.tasks[name] = Object.fromEntries(keys);
      for (const c of connections.filter((c) => c.to.name === model.name)) {
        made = operations.connect(made, c.from, { name, field: c.to.field });
        expected.connections.push(`${endText(c.from)} -> ${name}.${c.to.field}`);
      }
      return done(`add ${name}`, made);
    }
    if (kind === 2) {
      const name = operations.freeName(graph, "communicator", pick(["probe", "seen", "given"]));
      const keys: [string, string][] = [["type", "double"], ["direction", "in"], ["period", "100ms"]];
      expected.communicators[name] = Object.fromEntries(keys);
      return done(`add ${name}`, operations.addPart(graph, "communicator", name, keys));
    }
    if (kind === 3 && parts.length > 3) {
      // rather what was added
      const added = parts.filter((part) => /_\d+$|^(probe|seen|given)/.test(part.name));
      const part = added.length > 0 && random(8) > 0 ? pick(added) : pick(parts);
      delete expected[sectionOf(part.kind)][part.name];
      if (part.kind !== "distributer")
        expected.connections = expected.connections.filter((c) => !c.split("->").some((end) => end.trim().split(".")[0] === part.name));
      return done(`remove ${part.name}`, operations.removePart(graph, part));
    }
    if (kind === 4 || kind === 5) {
      const part: Part = pick(parts);
      const name = `${pick(["a", "renamed", "x_y", "Z"])}${random(1000)}`;
      const section = sectionOf(part.kind);
      expected[section] = Object.fromEntries(
        Object.entries(expected[section]).map(([key, value]) => [key === part.name ? name : key, value]),
      );
      if (part.kind === "distributer") {
        for (const communicator of Object.values(expected.communicators))
          if (String(communicator["channel"]).startsWith(`${part.name}.`))
            communicator["channel"] = String(communicator["channel"]).replace(part.name, name);
      } else expected.connections = expected.connections.map((c) => rename(c, part.name, name));
      return done(`rename ${part.name} to ${name}`, operations.renamePart(graph, part, name));
    }
    if (kind === 6 || kind === 7) {
      const part = pick(graph.of(pick<Kind>(["task", "communicator"])));
      const [key, value] = pick([
        ["wcet", `${1 + random(90)}us`],
        ["period", pick(["50ms", "100ms", "15ms", "5ms"])],
        ["offset", pick(["1ms", "5ms"])],
        ["on_fault", pick(["hold", "skip", "stop"])],
        ["priority", String(random(9))],
      ] as const);
      if (!part) return undefined;
      expected[sectionOf(part.kind)][part.name]![key] = value;
      const order = ["type", "channel", "period", "offset", "let", "wcet", "on_fault", "priority"];
      return done(`${part.name} ${key} ${value}`, operations.setValue(graph, [...part.path, key], value, order));
    }
    if (kind === 8) {
      const part = pick(tasks);
      if (!part) return undefined;
      const keys = graph.keysAt(part.path).filter((key) => key !== "type");
      if (keys.length === 0) return undefined;
      const key = pick(keys);
      delete expected.tasks[part.name]![key];
      return done(`${part.name} without ${key}`, operations.setValue(graph, [...part.path, key], undefined));
    }
    if (kind === 9 && tasks.length > 0) {
      const part = pick(tasks);
      const value = `${random(100) / 10}`;
      const entry = expected.tasks[part.name]!;
      const parameters = { ...((entry["parameters"] as Entry | undefined) ?? {}) };
      const inner = random(2) === 0;
      if (inner) parameters["deep"] = { ...((parameters["deep"] as Entry | undefined) ?? {}), er: value };
      else parameters["gain"] = value;
      entry["parameters"] = parameters;
      return done(`${part.name} parameter`, operations.setValue(graph, [...part.path, "parameters", ...(inner ? ["deep", "er"] : ["gain"])], value));
    }
    if (kind === 10 && tasks.length > 1) {
      const [from, to] = [pick(tasks), pick(tasks)];
      const ends = [{ name: from.name, field: "out" }, { name: to.name, field: `in_${random(99)}` }] as const;
      expected.connections.push(`${endText(ends[0])} -> ${endText(ends[1])}`);
      return done("connect", operations.connect(graph, ends[0], ends[1]));
    }
    if (kind === 11 && connections.length > 0) {
      const connection = pick(connections);
      expected.connections.splice(connection.index, 1);
      return done("disconnect", operations.removeConnection(graph, connection));
    }
    if (kind === 12 && connections.length > 1) {
      const [one, other] = [pick(connections), pick(connections)];
      expected.connections[one.index] = `${endText(other.from)} -> ${endText(one.to)}`;
      return done("reconnect", operations.reconnect(graph, one, other.from, one.to));
    }
    if (random(2) === 0 && connections.length > 1) {
      const connection = pick(connections);
      const by = random(2) === 0 ? -1 : 1;
      const [moved] = expected.connections.splice(connection.index, 1);
      expected.connections.splice(connection.index + by, 0, moved!);
      return done("move a connection", operations.moveConnection(graph, connection, by));
    }
    const part = pick(parts);
    if (!part) return undefined;
    const section = sectionOf(part.kind);
    const names = Object.entries(expected[section]);
    const at = names.findIndex(([name]) => name === part.name);
    const by = random(2) === 0 ? -1 : 1;
    const [moved] = names.splice(at, 1);
    names.splice(at + by, 0, moved!);
    expected[section] = Object.fromEntries(names);
    return done(`move ${part.name}`, operations.movePart(graph, part, by));
  } catch (why) {
    if (why instanceof CannotEdit) return undefined;
    throw why;
  }
}

/** The edit has done what it was to do, and nothing else. */
export function check(edit: Edit): void {
  const said = plainOf(edit.graph.text);
  const order = ({ tasks, communicators, distributers }: Plain): string[][] => [tasks, communicators, distributers].map(Object.keys);
  assert.deepEqual(order(said), order(edit.expected), edit.label);
  assert.deepEqual(said, edit.expected, edit.label);
  assert.deepEqual(
    edit.graph.parts.map((part) => part.name),
    [...Object.keys(said.distributers), ...Object.keys(said.communicators), ...Object.keys(said.tasks)],
  );
}

import assert from "node:assert/strict";
import { test } from "node:test";
import { wordText } from "../src/edit/entries.ts";
import { GraphText } from "../src/edit/graph_text.ts";
import { History } from "../src/edit/history.ts";
import * as operations from "../src/edit/operations.ts";
import { CannotEdit, commentsOf, differenceOf, offsetAt, placeOf, shownOf, typed } from "../src/edit/splice.ts";

const graph = (text: string): GraphText => new GraphText(text);
const task = (g: GraphText, name: string) => g.find("task", name)!;
const setOf = (text: string, path: string, value: string | undefined, order?: string[]): string =>
  operations.setValue(graph(text), path.split("."), value, order).text;

test("a word stands as it is where it may, else in quotes", () => {
  for (const plain of ["depth", "50ms", "0.6", "-3", "a b", "127.0.0.1:7000", "missions/dive.csv", "a#b", "0x4001"]) assert.equal(wordText(plain), plain);
  assert.equal(wordText("a: b"), '"a: b"');
  assert.equal(wordText("a, b"), '"a, b"');
  assert.equal(wordText("[::1]:7000"), '"[::1]:7000"');
  assert.equal(wordText("# a"), '"# a"');
  assert.equal(wordText(""), '""');
});

test("a value is put in the place of another, its comment and quotes stay", () => {
  assert.equal(setOf("tasks:\n  a:   {type: 'X', n: 1}   # c\n", "tasks.a.type", "Y"), "tasks:\n  a:   {type: 'Y', n: 1}   # c\n");
  assert.equal(setOf("tasks:\n  a:\n    type: X   # c\n", "tasks.a.type", "Y"), "tasks:\n  a:\n    type: Y   # c\n");
  assert.equal(setOf("tasks:\n  a:\n    type:\n", "tasks.a.type", "Y"), "tasks:\n  a:\n    type: Y\n");
  assert.equal(setOf("tasks:\n  a:\n    p:\n      k: 1\n    q: 2\n", "tasks.a.p", "{k: 2}"), "tasks:\n  a:\n    p: {k: 2}\n    q: 2\n");
});

test("a new key stands behind those that come before it, in the style of its entry", () => {
  const order = ["type", "period", "let", "wcet"];
  assert.equal(setOf("tasks: {a: {type: X, wcet: 1us}}\n", "tasks.a.let", "5ms", order), "tasks: {a: {type: X, let: 5ms, wcet: 1us}}\n");
  assert.equal(setOf("tasks:\n  a:\n    type: X  # t\n    wcet: 1us\n", "tasks.a.let", "5ms", order), "tasks:\n  a:\n    type: X  # t\n    let: 5ms\n    wcet: 1us\n");
  assert.equal(setOf("tasks:\n  a: {}\n", "tasks.a.parameters.lean.effect", "3"), "tasks:\n  a: {parameters: {lean: {effect: 3}}}\n");
  assert.equal(setOf("tasks:\n  a: {parameters: {lean: {x: 1}}}\n", "tasks.a.parameters.lean.effect", "3"), "tasks:\n  a: {parameters: {lean: {x: 1, effect: 3}}}\n");
  assert.equal(setOf("graph: a\n\ntasks: {}\n\nexpect: []\n", "platform.policy", "edf"), "graph: a\n\ntasks: {}\nplatform: {policy: edf}\n\nexpect: []\n");
});

test("a mapping goes with its last key, an entry does not", () => {
  assert.equal(setOf("tasks:\n  a: {type: X, parameters: {lean: {x: 1}}}\n", "tasks.a.parameters.lean.x", undefined), "tasks:\n  a: {type: X}\n");
  assert.equal(setOf("tasks:\n  a: {type: X}\n", "tasks.a.type", undefined), "tasks:\n  a: {}\n");
});

test("lists over several lines stay so, whatever stands beside their elements", () => {
  const text = "connections: [\n    a.x -> b.y,   # one\n    b.y -> c.z    # two\n  ]\ntasks: {a: {}, b: {}, c: {}, d: {}}\n";
  const more = operations.connect(graph(text), { name: "c", field: "z" }, { name: "d", field: "w" });
  assert.equal(more.text, "connections: [\n    a.x -> b.y,   # one\n    b.y -> c.z,    # two\n    c.z -> d.w\n  ]\ntasks: {a: {}, b: {}, c: {}, d: {}}\n");
  const without = operations.removeConnection(more, more.connections[0]!);
  assert.equal(without.text, "connections: [\n    # one\n    b.y -> c.z,    # two\n    c.z -> d.w\n  ]\ntasks: {a: {}, b: {}, c: {}, d: {}}\n");
  const last = operations.removeConnection(without, without.connections[1]!);
  assert.deepEqual(last.connections.map((c) => c.from.name), ["b"]);
  assert.equal(operations.removeConnection(last, last.connections[0]!).connections.length, 0);
});

test("a list that ends with a comma goes on so, also in its middle", () => {
  const text = "connections: [\n  a.x -> b.y,  # one\n  b.y -> c.z,\n]\n";
  assert.equal(operations.connect(graph(text), { name: "c", field: "z" }, { name: "d", field: "w" }).text, "connections: [\n  a.x -> b.y,  # one\n  b.y -> c.z,\n  c.z -> d.w,\n]\n");
  const entries = "tasks: {\n  a: {\n    type: X,  # t\n    wcet: 1us,\n  },\n}\n";
  assert.equal(setOf(entries, "tasks.a.let", "5ms", ["type", "let", "wcet"]), "tasks: {\n  a: {\n    type: X,  # t\n    let: 5ms,\n    wcet: 1us,\n  },\n}\n");
});

test("what is taken out leaves its comments on lines of their own", () => {
  const text = "tasks:\n  # first\n  a:            # of a\n    type: X     # its type\n  b: {type: Y}  # of b\nconnections:\n- a.x -> b.y  # arrow\n- b.y -> b.z\n";
  const made = operations.removePart(graph(text), task(graph(text), "a"));
  assert.equal(made.text, "tasks:\n  # first\n  # of a\n  # its type\n  b: {type: Y}  # of b\nconnections:\n# arrow\n- b.y -> b.z\n");
});

test("a section that has become empty takes entries again, and one that is not there is made in its place", () => {
  const empty = operations.removePart(graph("graph: a\n\ntasks:\n  a: {type: X}\n\nexpect: []\n"), { kind: "task", name: "a", at: { from: 0, to: 0 }, path: ["tasks", "a"] });
  assert.equal(empty.text, "graph: a\n\ntasks:\n\nexpect: []\n");
  assert.equal(operations.addPart(empty, "task", "b", [["type", "Y"]]).text, "graph: a\n\ntasks:\n  b: {type: Y}\n\nexpect: []\n");
  const made = operations.addPart(graph("graph: a\n\nexpect: []"), "task", "b", [["type", "Y"]]);
  assert.equal(made.text, "graph: a\n\ntasks:\n  b: {type: Y}\n\nexpect: []");
  assert.equal(operations.connect(made, { name: "b", field: "x" }, { name: "b", field: "y" }).text, "graph: a\n\ntasks:\n  b: {type: Y}\n\nconnections:\n  - b.x -> b.y\n\nexpect: []");
});

test("values stand below each other where they did", () => {
  const made = operations.addPart(graph("tasks:\n  long_name: {type: X}\n  b:         {type: Y}\n"), "task", "c", [["type", "Z"]]);
  assert.equal(made.text, "tasks:\n  long_name: {type: X}\n  b:         {type: Y}\n  c:         {type: Z}\n");
});

test("what is renamed is renamed wherever it is named, and nothing else is", () => {
  const text = `distributers: {depth: {type: V}}
communicators: {seen: {channel: depth.motion}, is_on: {type: bool, direction: in}, told: {type: double, direction: in}}
tasks:
  depth: {type: X}
  deep: {type: Y}
connections: [seen -> depth.in, "depth.out -> deep.in", deep.depth -> depth.b]
chains: {c: {path: [seen, depth, deep], reaction: 5ms}}
expect:
  - depth of depth within 0.1 of 3
  - never depth.out.depth is not depth
  - always seen.depth < 3 and is_on
  - max(told of depth) < 3
at_end: {command: {seen: {depth: 0}}, until: depth.out.z < 1, longest: 3s}
campaign: {vary: {tasks.depth.parameters.kp: 0..1}, metrics: {depth: max(depth.out.z)}}
profiles:
  depth:
    tasks.depth.parameters: {depth: 1}
    communicators.seen.timeout: 3s
    at_end: {command: {seen: {depth: 1}}, until: seen.z < 1}
    connections: [seen -> depth.in]
`;
  const g = graph(text);
  const renamed = operations.renamePart(g, task(g, "depth"), "dive").text;
  assert.equal(
    renamed,
    text
      .replace("  depth: {type: X}", "  dive: {type: X}")
      .replaceAll("seen -> depth.in", "seen -> dive.in")
      .replace("depth.out -> deep.in", "dive.out -> deep.in")
      .replace("deep.depth -> depth.b", "deep.depth -> dive.b")
      .replace("[seen, depth, deep]", "[seen, dive, deep]")
      .replace("never depth.out.depth is not depth", "never dive.out.depth is not depth")
      .replace("until: depth.out.z", "until: dive.out.z")
      .replaceAll("tasks.depth.", "tasks.dive.")
      .replace("max(depth.out.z)", "max(dive.out.z)"),
  );
  const system = operations.renamePart(g, g.find("distributer", "depth")!, "sub").text;
  assert.equal(system, text.replace("{depth: {type: V}}", "{sub: {type: V}}").replace("depth.motion", "sub.motion").replace("depth of depth", "depth of sub").replace("told of depth", "told of sub"));
  const communicator = operations.renamePart(g, g.find("communicator", "seen")!, "looked").text;
  assert.equal(communicator, text.replaceAll(/\bseen\b/g, "looked"));
  assert.equal(operations.renamePart(g, g.find("communicator", "told")!, "said").text, text.replace("told: {", "said: {"), "a true value of a vehicle may have the same name");
  assert.throws(() => operations.renamePart(g, task(g, "depth"), "seen"), new CannotEdit("there is a communicator 'seen'; choose another name"));
  assert.throws(() => operations.renamePart(g, task(g, "depth"), "1a"), new CannotEdit("'1a' is no name; use letters, digits and _, no digit first"));
});

test("an entry changes places with the comments that stand above it", () => {
  const text = "tasks:\n  a: {type: X}  # of a\n\n  # about b\n  b:\n    type: Y\n";
  const g = graph(text);
  assert.equal(operations.movePart(g, task(g, "b"), -1).text, "tasks:\n  # about b\n  b:\n    type: Y\n\n  a: {type: X}  # of a\n");
  assert.throws(() => operations.movePart(g, task(g, "a"), -1), new CannotEdit("there is nothing to change places with"));
});

test("ends of lines stay what they are, also where people type", () => {
  const text = "tasks:\r\n  a: {type: X}\r\n# end\r\n";
  assert.equal(operations.addPart(graph(text), "task", "b", [["type", "Y"]]).text, "tasks:\r\n  a: {type: X}\r\n  b: {type: Y}\r\n# end\r\n");
  assert.equal(typed(text, "tasks:\n  a: {type: Z}\n\n# end\n"), "tasks:\r\n  a: {type: Z}\r\n\r\n# end\r\n");
  assert.equal(typed("a\nb", "a\nb"), "a\nb");
  const removed = operations.removePart(graph(text), task(graph(text), "a"));
  assert.equal(removed.text, "tasks:\r\n# end\r\n");
});

test("a carriage return alone, which ends no line, is shown and stays, whatever else the ends of lines are", () => {
  for (const text of ["graph: a\rtasks:\r  c: {wcet: 1us}\r", "# a\rb\nc: 1us\n", "# a\rb\r\nc: 1us\r\n", "# a\r\r\nc: 1us\r\n"]) {
    const shown = shownOf(text);
    assert.ok(!shown.includes("\r"), "a browser would make an end of a line of it");
    assert.equal(shown.split("\n").length, text.split("\n").length, "lines are those of the loader");
    assert.equal(typed(text, shown.replace("1us", "2us")), text.replace("1us", "2us"));
    assert.equal(text.slice(placeOf(text, shown.indexOf("1us"))).slice(0, 3), "1us");
  }
  // a copy of it is one, too
  assert.equal(typed("a\rb\n", "a\u240db\na\u240db\n"), "a\rb\na\rb\n");
  assert.equal(typed("# \u240d\n", "# \u240d\u240d\n"), "# \u240d\u240d\n");
});

test("what can't be edited without harm is refused with a reason", () => {
  const anchored = graph("tasks:\n  a: &one {type: X}\n  b: *one\n");
  assert.throws(() => operations.removePart(anchored, { kind: "task", name: "a", at: { from: 0, to: 0 }, path: ["tasks", "a"] }), CannotEdit);
  assert.throws(
    () => operations.setValue(anchored, ["tasks", "a", "type"], "Y"),
    new CannotEdit("what stands there is used elsewhere, too, as '*one'; change it in the text"),
  );
  const inner = graph("tasks:\n  a: {type: X, parameters: {k: &k 1}}\n  b: {type: X, parameters: {k: *k}}\n");
  assert.throws(() => operations.setValue(inner, ["tasks", "a", "parameters"], undefined), CannotEdit);
  assert.throws(
    () => operations.addPart(graph("tasks: &t\n  a: {type: X}\nmore: *t\n"), "task", "b", [["type", "X"]]),
    new CannotEdit("what stands there is used elsewhere, too, as '*t'; change it in the text"),
  );
  assert.throws(() => operations.addPart(graph("---\n...\n"), "task", "a", [["type", "X"]]), CannotEdit);
  const unused = graph("tasks:\n  a: &one {type: X}\n  b: {type: X}\n");
  assert.equal(operations.setValue(unused, ["tasks", "a", "type"], "Y").text, "tasks:\n  a: &one {type: Y}\n  b: {type: X}\n");
  const broken = graph("tasks: [\n");
  assert.throws(
    () => operations.addPart(broken, "task", "a", [["type", "X"]]),
    new CannotEdit("the text is no YAML as it stands; mend that in the text first, or undo"),
  );
  assert.throws(() => operations.connect(graph("connections: [a -> b]\n"), { name: "a", field: "" }, { name: "b", field: "" }), new CannotEdit("there is a -> b"));
  assert.throws(() => operations.writtenOf("{a: 1", true), new CannotEdit("'{a: 1' is no value; write a number or word, {key: value} or [1, 2]"));
  assert.throws(() => operations.writtenOf("1, 2", true), CannotEdit);
  assert.equal(operations.writtenOf(" {a: [1, 2]} ", true), "{a: [1, 2]}");
});

test("what check suggests is set as --set would", () => {
  const taken = operations.takeSuggestion(graph("graph: a\ntasks:\n  a: {type: X, priority: 3}\n"), ["tasks.a.priority=null", "tasks.a.offset=2ms", "platform.cores=2"]);
  assert.equal(taken.text, "graph: a\ntasks:\n  a: {type: X, offset: 2ms}\nplatform: {cores: 2}\n");
});

test("what is typed in one go is one step back, and steps are not without end", () => {
  const history = new History("a", 40);
  history.add("ab", "typing", 1000);
  history.add("abc", "typing", 1500);
  history.add("abcd", "typing", 9000);
  assert.equal(history.undo(), "abc");
  assert.equal(history.undo(), "a");
  assert.equal(history.undoes, undefined);
  assert.equal(history.redo(), "abc");
  history.add("x".repeat(20), "paste");
  assert.equal(history.redoes, undefined);
  history.add("y".repeat(20), "paste");
  while (history.undoes !== undefined) history.undo();
  assert.equal(history.text, "a");
});

test("places are counted as the loader counts them, and comments are found where they are", () => {
  const text = "a: \u00e4\u20ac\ud83d\ude00x  # c\nb: '# none' # d\n";
  assert.equal(text[offsetAt(text, 1, 4 + 2 + 3 + 4)], "x");
  assert.equal(offsetAt(text, 2, 1), text.indexOf("b:"));
  assert.equal(offsetAt(text, 9, 9), text.length);
  assert.deepEqual(commentsOf(text).map(({ from, to }) => text.slice(from, to)), ["# c", "# d"]);
  assert.deepEqual(differenceOf("abc", "aXc"), { from: 1, to: 2, insert: "X" });
});

test("what the loader means is written where the wrong word stands", () => {
  const text = "tasks:\n  a: {perid: 5ms}\nconnections: ['a.out -> b.inn']\n";
  const key = operations.meantBy(graph(text), "task 'a' has no key 'perid'; did you mean 'period'?; it has: type", text.indexOf("perid"))!;
  assert.equal(operations.takeMeant(graph(text), key).text, text.replace("perid", "period"));
  const end = operations.meantBy(graph(text), "task 'b' (Sum) has no input 'inn'; did you mean 'in'?; it has: in", text.indexOf("b.inn"))!;
  assert.equal(operations.takeMeant(graph(text), end).text, text.replace("inn", "in"));
  assert.equal(operations.meantBy(graph(text), "task 'a' has no key 'other'; did you mean 'period'?", text.indexOf("perid")), undefined);
  assert.equal(operations.meantBy(graph(text), "task 'a' lacks the key 'type'", 0), undefined);
});

test("a text without anything, or of comments alone, is begun", () => {
  for (const text of ["", "# mine\n", "# mine"]) {
    const begun = operations.addPart(graph(text), "task", "a", [["type", "X"]]);
    assert.equal(begun.text, `${text === "" ? "" : "# mine\n"}tasks:\n  a: {type: X}\n`);
  }
});

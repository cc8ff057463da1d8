import assert from "node:assert/strict";
import { test } from "node:test";
import { columnsOf, csvOf, defaultPlots, plotsOf, type Line } from "../src/plots.ts";
import type { Hello, Output } from "../src/protocol.ts";
import { Store } from "../src/series.ts";

const outputs: Output[] = [
  {
    name: "from",
    type: "Setpoint",
    kind: "communicator",
    of: "from",
    leaves: [
      { path: "depth", unit: "m", kind: "number" },
      { path: "turn", unit: "", kind: "enum" },
    ],
  },
  {
    name: "to",
    type: "Report",
    kind: "communicator",
    of: "to",
    leaves: [
      { path: "depth", unit: "m", kind: "number" },
      { path: "heading", unit: "rad", kind: "number" },
    ],
  },
  { name: "true dune", type: "Truth", kind: "truth", of: "dune", leaves: [{ path: "depth", unit: "m", kind: "number" }] },
];
const hello = {
  outputs,
  pairs: [
    { title: "depth", commanded: "from.depth", reached: "to.depth" },
    { title: "gone", commanded: "none.x", reached: "to.depth" },
    { title: "turn", commanded: "from.turn", reached: "to.depth" },
  ],
} as unknown as Hello;
const lines = (store: Store, ...names: string[]): Line[] =>
  names.map((name) => ({ signal: store.find(name)!, role: "other" }));

test("by default what is commanded is plotted against what is reached and true", () => {
  const plots = defaultPlots(hello, new Store(outputs));
  assert.deepEqual(
    plots.map((plot) => plot.lines.map(({ signal, role }) => `${signal.name} ${role}`)),
    [["from.depth commanded", "to.depth reached", "true dune.depth true"]],
  );
});

test("after a break the same is plotted of the values that come anew, but for what is not there any more", () => {
  const before = new Store(outputs);
  const plots = [
    { title: "mine", lines: lines(before, "to.heading", "true dune.depth") },
    { title: "gone", lines: lines(before, "true dune.depth") },
  ];
  const store = new Store(outputs.slice(0, 2));
  assert.deepEqual(plotsOf(store, plots), [{ title: "mine", lines: lines(store, "to.heading") }]);
});

test("a graph without commands has its first numbers plotted", () => {
  const plots = defaultPlots({ ...hello, pairs: [] }, new Store(outputs));
  assert.deepEqual(
    plots.map(({ title }) => title),
    ["from.depth", "to.depth", "to.heading"],
  );
});

test("lines of different instants stand in one table", () => {
  const store = new Store(outputs);
  store.add([
    [0, 0, 1, 0],
    [1, 0.5, 10, 0],
    [0, 1, 2, 0],
    [1, 1, 20, 0],
  ]);
  assert.deepEqual(columnsOf(store, lines(store, "from.depth", "to.depth"), 0, 2, 100), [
    [0, 0.5, 1],
    [1, undefined, 2],
    [undefined, 10, 20],
  ]);
});

test("a window begins with what held at its begin", () => {
  const store = new Store(outputs);
  for (let t = 0; t < 10; ++t) store.add([[0, t, t, 0]]);
  assert.deepEqual(columnsOf(store, lines(store, "from.depth"), 3.5, 5.5, 100)[0], [3, 4, 5]);
});

test("long lines are thinned, and their newest value is there", () => {
  const store = new Store(outputs);
  for (let t = 0; t < 10_000; ++t) store.add([[0, t, t, 0]]);
  const [times, values] = columnsOf(store, lines(store, "from.depth"), 0, 1e9, 100);
  assert.ok(times.length <= 101);
  assert.equal(times.at(-1), 9999);
  assert.equal(values!.at(-1), 9999);
});

test("angles are shown in degrees, with a gap where they jump by a turn", () => {
  const store = new Store(outputs);
  store.add([
    [1, 0, 0, Math.PI / 2],
    [1, 1, 0, Math.PI],
    [1, 2, 0, -Math.PI],
    [1, 3, 0, -Math.PI / 2],
  ]);
  assert.deepEqual(columnsOf(store, lines(store, "to.heading"), 0, 9, 100)[1], [90, 180, null, -90]);
});

test("among instants of faster lines the gap of a jump is as long as the jump", () => {
  const store = new Store(outputs);
  store.add([
    [1, 0, 0, Math.PI],
    [0, 1, 1, 0],
    [0, 2, 2, 0],
    [1, 3, 0, -Math.PI],
  ]);
  assert.deepEqual(columnsOf(store, lines(store, "to.heading", "from.depth"), 0, 9, 100)[1], [180, null, null, -180]);
});

test("a table of values has all of them in the units of the graph", () => {
  const store = new Store(outputs);
  store.add([
    [0, 0, 1, 0],
    [1, 0.5, 10, 0.25],
    [0, 1, 2, 0],
  ]);
  assert.equal(
    csvOf(store, lines(store, "from.depth", "to.heading"), 0, 0.9),
    "time,from.depth,to.heading\ns,m,rad\n0,1,\n0.5,,0.25\n",
  );
});

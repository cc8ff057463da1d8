import assert from "node:assert/strict";
import { test } from "node:test";
import type { Leaf, Output } from "../src/protocol.ts";
import { Series, Store } from "../src/series.ts";

const leaf = (path: string, kind: Leaf["kind"] = "number", unit = ""): Leaf => ({ path, unit, kind });
const output = (name: string, ...leaves: Leaf[]): Output => ({
  name,
  type: "T",
  kind: "task",
  of: name.split(".")[0]!,
  leaves,
});

test("a sample holds until the next one", () => {
  const series = new Series(output("a.b", leaf("")));
  assert.equal(series.at(1), -1);
  assert.ok(Number.isNaN(series.number(0, 1)));
  series.add(1, [10]);
  series.add(2, [20]);
  assert.equal(series.number(0, 0.5), NaN);
  assert.equal(series.number(0, 1), 10);
  assert.equal(series.number(0, 1.99), 10);
  assert.equal(series.number(0, 2), 20);
  assert.equal(series.number(0, 100), 20);
});

test("a sample of the same instant replaces, one of an instant before is not taken", () => {
  const series = new Series(output("a.b", leaf("")));
  series.add(1, [10]);
  series.add(1, [11]);
  series.add(0.5, [5]);
  assert.equal(series.count, 1);
  assert.equal(series.number(0, 1), 11);
});

test("what is no number is not one; texts are kept", () => {
  const series = new Series(output("a.b", leaf("n"), leaf("t", "text")));
  series.add(1, [null, [1, 2]]);
  series.add(2, [3, "words"]);
  assert.ok(Number.isNaN(series.number(0, 1)));
  assert.deepEqual(series.cell(1, 0), [1, 2]);
  assert.equal(series.cell(1, 1), "words");
  assert.equal(series.cell(0, 1), 3);
});

test("memory is bounded: the older half is thinned, the newest is to the full", () => {
  const series = new Series(output("a.b", leaf("n"), leaf("t", "text")), 1000);
  for (let i = 0; i < 100_000; ++i) series.add(i, [i, String(i)]);
  assert.ok(series.count <= 1000);
  assert.ok(series.times.length <= 1000);
  assert.equal(series.times[0], 0);
  assert.equal(series.number(0, 1e9), 99_999);
  assert.equal(series.times[series.count - 2], 99_998);
  for (let i = 0; i < series.count; ++i) {
    assert.equal(series.columns[0]![i], series.times[i]);
    assert.equal(series.cell(1, i), String(series.times[i]));
    if (i > 0) assert.ok(series.times[i]! > series.times[i - 1]!);
  }
});

test("signals have the names of traces", () => {
  const store = new Store([output("a.b", leaf("x"), leaf("y.0")), null, output("c", leaf(""))]);
  assert.deepEqual(
    store.signals.map(({ name }) => name),
    ["a.b.x", "a.b.y.0", "c"],
  );
  store.add([
    [0, 1, 5, 6],
    [2, 2, 7],
    [1, 3, 8],
    [9, 4, 8],
  ]);
  assert.equal(store.number(store.find("a.b.y.0")!, 1), 6);
  assert.equal(store.number(store.find("c")!, 2), 7);
  assert.equal(store.newest, 4);
  assert.equal(store.find("none"), undefined);
});

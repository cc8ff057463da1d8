import assert from "node:assert/strict";
import { test } from "node:test";
import { frameOf, lengthText, roundLength, toPoint, toSpot, zoomed } from "../src/map.ts";
import { commandOf, quoted, wrongValue } from "../src/parameters.ts";
import type { Hello, Parameter, Task } from "../src/protocol.ts";
import { activationsOf, executionsOf, windowOf } from "../src/timeline.ts";

test("lengths of scales are round", () => {
  assert.deepEqual([0.3, 1, 4.9, 7, 60, 2500].map(roundLength), [0.2, 1, 2, 5, 50, 2000]);
  assert.deepEqual([0.2, 5, 2000].map(lengthText), ["20 cm", "5 m", "2 km"]);
});

test("a map has all spots in sight, north up, and no less than it needs", () => {
  const frame = frameOf([[0, 0], [10, 40]], 400, 200, 4);
  assert.deepEqual(toPoint(frame, [5, 20]), [200, 100]);
  const [x, y] = toPoint(frame, [10, 40]);
  assert.ok(x > 200 && x <= 400 && y < 100 && y >= 0);
  assert.equal(frameOf([[3, 3]], 400, 200, 4).scale, 50);
  assert.equal(frameOf([], 400, 200, 4).north, 0);
});

test("a map that has no room yet has a scale all the same", () => {
  for (const [width, height] of [[0, 241], [300, 0], [0, 0]] as const) {
    const frame = frameOf([[0, 0], [10, 40]], width, height, 20);
    assert.ok(Number.isFinite(roundLength(110 / frame.scale) * frame.scale), `${width} by ${height}`);
  }
});

test("a spot stays under the pointer that zooms", () => {
  const frame = frameOf([[0, 0], [10, 40]], 400, 200, 4);
  const before = toSpot(frame, 30, 170);
  const after = toSpot(zoomed(frame, 3, 30, 170), 30, 170);
  assert.ok(Math.abs(before[0] - after[0]) < 1e-9 && Math.abs(before[1] - after[1]) < 1e-9);
});

const task = (changes: Partial<Task>): Task => ({
  name: "a", type: "A", period: 0.05, offset: 0.01, deadline: 0.02, parameters: [], ...changes,
});

test("activations are those whose LET or deadline touches the window", () => {
  const found = activationsOf(task({}), 0.1, 0.2);
  assert.deepEqual(found.map(({ k }) => k), [2, 3]);
  assert.ok(Math.abs(found[0]!.release - 0.11) < 1e-12 && Math.abs(found[0]!.end - 0.13) < 1e-12);
  assert.deepEqual(activationsOf(task({ let: 0.05 }), 0.1, 0.2).map(({ k }) => k), [1, 2, 3]);
  assert.deepEqual(activationsOf(task({ offset: 0 }), 0, 0.1).map(({ k }) => k), [0, 1, 2]);
  assert.equal(activationsOf(task({ period: 1e-6 }), 0, 1).length, 500);
});

test("of a schedule whose begin is another one the last round repeats", () => {
  const schedule = { until: 0.25, round: 0.1, slices: [[0, 0.05, 0.06], [0, 0.14, 0.16], [0, 0.24, 0.25]] as [number, number, number][] };
  const begins = (from: number, to: number) => executionsOf(schedule, from, to).map(({ begin, end }) => `${begin.toFixed(2)}-${end.toFixed(2)}`);
  assert.deepEqual(begins(0, 0.3), ["0.05-0.06", "0.14-0.16", "0.24-0.25", "0.25-0.26"]);
  assert.deepEqual(begins(0.25, 0.45), ["0.25-0.26", "0.34-0.35", "0.35-0.36", "0.44-0.45"]);
  assert.deepEqual(begins(10.255, 10.4), ["10.25-10.26", "10.34-10.35", "10.35-10.36"]);
});

test("a schedule repeats if a whole round of it is known", () => {
  const schedule = { until: 0.1, round: 0.1, slices: [[0, 0, 0.01]] as [number, number, number][] };
  assert.deepEqual(executionsOf(schedule, 0.15, 0.35).map(({ begin }) => Number(begin.toFixed(6))), [0.2, 0.3]);
  assert.deepEqual(executionsOf({ until: 0.1, slices: schedule.slices }, 0.15, 0.35), []);
  assert.deepEqual(executionsOf(undefined, 0, 1), []);
  const hello = { tasks: [task({}), task({ period: 0.1 })], schedule } as unknown as Hello;
  assert.equal(windowOf(hello), 0.2);
});

const parameter = (changes: Partial<Parameter>): Parameter => ({
  path: "kp", kind: "number", unit: "rad/m", value: "0.4", default: "0.4", ...changes,
});

test("what can't be a parameter is said", () => {
  assert.equal(wrongValue(parameter({}), "0.5"), "");
  assert.equal(wrongValue(parameter({}), "fast"), "a number");
  assert.equal(wrongValue(parameter({}), " "), "a number");
  assert.equal(wrongValue(parameter({}), "0x10"), "a number");
  assert.equal(wrongValue(parameter({}), "-1.5e-3"), "");
  assert.equal(wrongValue(parameter({ kind: "integer" }), "1.5"), "a whole number");
  assert.equal(wrongValue(parameter({ min: 0, max: 1 }), "2"), "a number from 0 to 1");
  assert.equal(wrongValue(parameter({ kind: "bool" }), "yes"), "true or false");
  assert.equal(wrongValue(parameter({ kind: "enum", words: ["a", "b"] }), "c"), "one of a, b");
});

test("changes become the command of the next run, safe in a shell", () => {
  const hello = {
    file: "my specs/dive.yaml",
    tasks: [task({ name: "depth", parameters: [parameter({}), parameter({ path: "name", kind: "text", value: "x" })] })],
  } as unknown as Hello;
  assert.equal(commandOf(hello, new Map()), "jarol run 'my specs/dive.yaml'");
  assert.equal(
    commandOf(hello, new Map([["depth.kp", "0.2"], ["depth.name", "it's; rm"]])),
    `jarol run 'my specs/dive.yaml' --set tasks.depth.parameters.kp=0.2 --set 'tasks.depth.parameters.name=it'\\''s; rm'`,
  );
  assert.equal(quoted("a=b,c"), "a=b,c");
  // an operator at the page needs one in the next run, too
  const desks = [{ name: "terminal", type: "JaviatorOperator" }];
  assert.equal(commandOf({ ...hello, desks } as Hello, new Map()), "jarol run 'my specs/dive.yaml' --console");
});

test("the next run has what this one was begun with, too, but for what is changed", () => {
  const hello = {
    file: "dive.mcap",
    given: { file: "specs/dive.yaml", profile: "at_sea", seed: 7, set: ["tasks.depth.parameters.kp=0.3", "at_end.longest=2 s"] },
    tasks: [task({ name: "depth", parameters: [parameter({})] })],
  } as unknown as Hello;
  assert.equal(
    commandOf(hello, new Map()),
    "jarol run specs/dive.yaml --profile at_sea --seed 7 --set tasks.depth.parameters.kp=0.3 --set 'at_end.longest=2 s'",
  );
  assert.equal(
    commandOf(hello, new Map([["depth.kp", "0.2"]])),
    "jarol run specs/dive.yaml --profile at_sea --seed 7 --set 'at_end.longest=2 s' --set tasks.depth.parameters.kp=0.2",
  );
});

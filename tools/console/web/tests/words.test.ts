import assert from "node:assert/strict";
import { test } from "node:test";
import { EventLog, maxEvents } from "../src/events.ts";
import { formatCell, formatDuration, formatMarks, formatNumber, formatTime } from "../src/format.ts";
import { GraphModel } from "../src/graph.ts";
import { parseMessage, schema, type Hello, type Leaf } from "../src/protocol.ts";
import { Store } from "../src/series.ts";
import { poseAt, vehicleOf } from "../src/vehicles.ts";

const leaf = (kind: Leaf["kind"], unit = "", path = ""): Leaf => ({ path, unit, kind });

test("numbers have their unit, angles are degrees", () => {
  assert.equal(formatCell(leaf("number", "m"), 1.23456), "1.235\u202fm");
  assert.equal(formatCell(leaf("number", "rad"), Math.PI), "180.0\u202f°");
  assert.equal(formatCell(leaf("number"), 12), "12");
  assert.equal(formatCell(leaf("bool"), 1), "yes");
  assert.equal(formatCell({ ...leaf("enum"), words: [{ number: 2, name: "two" }] }, 2), "two");
  assert.equal(formatCell({ ...leaf("enum"), words: [] }, 7), "7");
  assert.equal(formatCell(leaf("number"), null), "–");
  assert.equal(formatCell(leaf("text"), "a"), "a");
  assert.equal(formatCell(leaf("text"), [1, 2]), "[1,2]");
});

test("the marks of an axis can be told apart, at any size", () => {
  assert.deepEqual(formatMarks([-0.5, 0, 0.5, 1]), ["-0.5", "0", "0.5", "1.0"]);
  assert.deepEqual(formatMarks([0, 0.25, 0.5]), ["0", "0.25", "0.50"]);
  assert.deepEqual(formatMarks([100, 102, 104]), ["100", "102", "104"]);
  assert.deepEqual(formatMarks([0, 25]), ["0", "25"]);
  assert.deepEqual(formatMarks([-2e-7, 0, 2e-7]), ["-2e-7", "0", "2e-7"]);
  assert.deepEqual(formatMarks([1e-6, 1.25e-6]), ["1.00e-6", "1.25e-6"]);
  assert.deepEqual(formatMarks([9.99e6, 1e7]), ["9.99e+6", "1.000e+7"]);
  assert.deepEqual(formatMarks([7]), ["7"]);
});

test("numbers of any size fit", () => {
  assert.equal(formatNumber(-0.0001, 1), "0.0");
  assert.equal(formatNumber(1e-9), "1.00e-9");
  assert.equal(formatNumber(-9e-16, 2), "0.00");
  assert.equal(formatNumber(12345.6), "12346");
  assert.equal(formatNumber(NaN), "–");
  assert.equal(formatDuration(0.05), "50 ms");
  assert.equal(formatDuration(0.0000123), "12.3 µs");
  assert.equal(formatDuration(3), "3 s");
  assert.equal(formatTime(75.5), "1:15.50");
});

test("a server of another schema is said, garbage is none", () => {
  assert.throws(() => parseMessage('{"hello": {"schema": "jarol.console/9"}}'), /speaks jarol.console\/9, the page/);
  assert.throws(() => parseMessage('{"what": 1}'), /the server sent what/);
  assert.throws(() => parseMessage("1"), /expected an object/);
  assert.throws(() => parseMessage("{"));
  assert.deepEqual(parseMessage('{"now": 1}'), { now: 1 });
  assert.ok("hello" in parseMessage(`{"hello": {"schema": "${schema}"}}`));
});

const hello = {
  communicators: [
    { name: "to", direction: "out", period: 0.1 },
    { name: "from", direction: "in", period: 0.1 },
  ],
  tasks: [{ name: "steer", period: 0.05, slack: 0.01, let: 0.02 }],
  outputs: [
    {
      name: "to",
      type: "Report",
      kind: "communicator",
      of: "to",
      leaves: [
        {
          ...leaf("enum", "", "alarm"),
          words: [
            { number: 0, name: "none" },
            { number: 1, name: "leak", meaning: "it comes up" },
          ],
        },
      ],
    },
    { name: "from", type: "F", kind: "communicator", of: "from", leaves: [leaf("enum", "", "x")] },
    { name: "steer.out", type: "double", kind: "task", of: "steer", leaves: [leaf("number", "m")] },
    { name: "goal", type: "Goal", kind: "communicator", of: "goal", leaves: [leaf("number", "m", "depth")] },
  ],
  pairs: [{ title: "depth", commanded: "goal.depth", reached: "steer.out" }],
  drawing: { nodes: [{ kind: "task", name: "steer" }, { kind: "out", name: "to" }, { kind: "distributer", name: "d" }] },
} as unknown as Hello;

test("what the vehicle tells the outside is an event when it changes", () => {
  const log = new EventLog(hello);
  log.look([
    [0, 0, 0],
    [1, 0, 0],
    [0, 1, 0],
    [1, 1, 5],
    [0, 2, 1],
    [0, 3, 0],
  ]);
  assert.deepEqual(log.all, [
    { t: 2, kind: "event", text: "to.alarm is leak: it comes up" },
    { t: 3, kind: "event", text: "to.alarm is none" },
  ]);
});

test("what is asked for is an event once it has stayed for half a second: a stick that moves is none", () => {
  const log = new EventLog(hello);
  const at = (t: number, depth: number) => log.look([[3, t, depth]]);
  for (let t = 0; t < 2; t += 0.1) at(t, 0);
  at(2, 3);
  at(2.4, 3);
  assert.deepEqual(log.all, []);
  at(2.5, 3);
  for (let i = 0; i < 20; ++i) at(3 + i * 0.1, 3 + i);
  at(5.5, 22);
  assert.deepEqual(log.all, [
    { t: 2, kind: "operator", text: "depth 3\u202fm" },
    { t: 4.9, kind: "operator", text: "depth 22\u202fm" },
  ]);
  // of what comes of another output the instant may be before
  log.addRunEvents([{ t: 3, kind: "fault", task: "steer", activation: 60, text: "was late" }]);
  assert.deepEqual(log.all.map(({ t }) => t), [2, 3, 4.9]);
});

test("faults name task and activation; of too many the oldest go, and are counted", () => {
  const log = new EventLog(hello);
  log.addRunEvents([{ t: 1, kind: "fault", task: "steer", activation: 20, text: "was late" }]);
  assert.equal(log.all[0]!.text, "steer: was late (activation 20)");
  for (let i = 0; i < maxEvents; ++i) log.add({ t: 2, kind: "page", text: "x" });
  assert.equal(log.all.length, maxEvents);
  assert.equal(log.dropped, 1);
});

test("a node has the age of what it published, and is stale when that is missing", () => {
  const store = new Store(hello.outputs);
  const model = new GraphModel(hello, store);
  assert.deepEqual(model.periods, [0.05, 0.1]);
  const faults = new Map([["steer", 3]]);
  assert.equal(model.state(0, 1, faults).age, undefined);
  assert.equal(model.state(0, 1, faults).stale, false);
  assert.equal(model.state(0, 1, faults).value, "");
  store.add([[2, 1, 7]]);
  const fresh = model.state(0, 1.02, faults);
  assert.ok(Math.abs(fresh.age! - 0.02) < 1e-9);
  assert.equal(fresh.faults, 3);
  assert.equal(fresh.value, "7 m".replace(" ", "\u202f"));
  assert.equal(fresh.slack, 0.01);
  assert.equal(fresh.stale, false);
  assert.equal(model.state(0, 2, faults).stale, true);
  assert.equal(model.state(2, 2, faults).period, 0);
  assert.deepEqual(
    model.values(0, 2).map(({ title, cell }) => [title, cell]),
    [["out", 7]],
  );
});

test("a submarine is known by its types: below zero is down", () => {
  const paths = ["x", "y", "z", "phi", "theta", "psi", "u"];
  const store = new Store([
    { name: "n.motion", type: "Motion", kind: "task", of: "n", leaves: paths.map((path) => leaf("number", "m", path)) },
  ]);
  const vehicle = vehicleOf(store)!;
  assert.equal(vehicle.kind, "submarine");
  assert.equal(poseAt(store, vehicle.estimate!, 0), undefined);
  store.add([[0, 0, 1, 2, 3, 0.1, 0.2, 0.3, 1.2]]);
  assert.deepEqual(poseAt(store, vehicle.estimate!, 0), {
    x: 1,
    y: 2,
    down: 3,
    roll: 0.1,
    pitch: 0.2,
    heading: 0.3,
    speed: 1.2,
  });
});

test("a helicopter's altitude is up; of a graph without a vehicle there is none", () => {
  const paths = ["x", "y", "altitude", "roll", "pitch", "yaw", "climb"];
  const store = new Store([
    {
      name: "f.estimate",
      type: "FlightEstimate",
      kind: "task",
      of: "f",
      leaves: paths.map((path) => leaf("number", "m", path)),
    },
  ]);
  store.add([[0, 0, 1, 2, 3, 0, 0, 0, 0]]);
  assert.equal(poseAt(store, vehicleOf(store)!.estimate!, 0)!.down, -3);
  assert.equal(vehicleOf(new Store([])), undefined);
});

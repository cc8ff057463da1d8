import assert from "node:assert/strict";
import { test } from "node:test";
import type { Hello } from "../src/protocol.ts";
import { StickReader } from "../src/sticks.ts";
import { Goals, limitsOf, phaseOf, stickPlan } from "../src/submarine.ts";

const centred = { turn: 0, drive: 0, dive: 0 };
const limits = { depth: 11, speed: 1.6 };
function goalsAt(depth: number, heading: number, speed: number): Goals {
  const goals = new Goals();
  goals.adopt({ depth, heading, speed }, limits);
  return goals;
}

test("who takes over changes nothing: goals are where the vehicle is, and afloat and adrift they are nought", () => {
  assert.deepEqual({ ...goalsAt(3.2, 1, 1.25) }, { depth: 3.2, heading: 1, speed: 1.25 });
  assert.deepEqual({ ...goalsAt(0.054, 7, 0.01) }, { depth: 0, heading: 7 - 2 * Math.PI, speed: 0 });
  assert.deepEqual({ ...goalsAt(NaN, NaN, NaN) }, { depth: 0, heading: 0, speed: 0 });
  assert.deepEqual({ ...goalsAt(50, 0, 9) }, { depth: 11, heading: 0, speed: 1.6 });
});

test("the autopilot gets depth, heading and speed in IMC", () => {
  assert.deepEqual(goalsAt(3, 1, 1.2).messages(centred, "autopilot", false), [
    ["DesiredZ", { value: 3, z_units: "DEPTH" }],
    ["DesiredHeading", { value: 1 }],
    ["DesiredSpeed", { value: 1.2, speed_units: "METERS_PS" }],
  ]);
});

test("by hand it gets the stick, and a depth only once it is steered by hand", () => {
  const goals = goalsAt(3, 1, 1.2);
  const hand = ["RemoteActions", { actions: "Heading=127;Thrust=-63" }];
  assert.deepEqual(goals.messages({ turn: 1, drive: -0.5, dive: 0 }, "hand", false), [hand]);
  assert.deepEqual(goals.messages({ turn: 1, drive: -0.5, dive: 0 }, "hand", true), [
    hand,
    ["DesiredZ", { value: 3, z_units: "DEPTH" }],
  ]);
  assert.deepEqual(goals.messages(centred, "hand", false), [["RemoteActions", { actions: "Heading=0;Thrust=0" }]]);
});

test("who steers nothing is heard, and commands nothing", () => {
  assert.deepEqual(goalsAt(3, 1, 1.2).messages({ ...centred, turn: 1 }, "", false), [["Heartbeat", {}]]);
});

test("sticks move the goals within their limits; by hand the depth only", () => {
  const goals = goalsAt(3, 3, 1);
  goals.move({ turn: 1, drive: -1, dive: 1 }, 1, "autopilot", limits);
  assert.ok(Math.abs(goals.heading - (3 + Math.PI / 9 - 2 * Math.PI)) < 1e-12);
  assert.deepEqual([goals.depth, goals.speed], [3.5, 0.6]);
  goals.move({ turn: 0, drive: 1, dive: 1 }, 100, "autopilot", limits);
  assert.deepEqual([goals.depth, goals.speed], [11, 1.6]);
  goals.move({ turn: 1, drive: -1, dive: -1 }, 1, "hand", limits);
  assert.deepEqual([goals.depth, goals.speed], [10.5, 1.6]);
});

test("a metre is left to the depth at which it would come up by itself", () => {
  const hello = { tasks: [{ type: "LauvSupervisor", parameters: [{ path: "max_depth", value: "6" }] }] } as unknown as Hello;
  assert.equal(limitsOf(hello).depth, 5);
  assert.equal(limitsOf({ tasks: [] } as unknown as Hello).depth, 11);
});

test("down, ahead and to starboard are the keys' ways", () => {
  const input = new StickReader(stickPlan);
  for (const key of ["ArrowDown", "KeyW", "ArrowRight"]) input.press(key);
  assert.deepEqual(input.read(), { turn: 1, drive: 1, dive: 1 });
  input.letGo();
  assert.deepEqual(input.read([0, -1, 0, 0]), { turn: 0, drive: 1, dive: 0 });
});

test("what the vehicle does is said as it says", () => {
  const kind = (vehicle: object | undefined, plan = {}, alarm = "none") =>
    phaseOf(vehicle as Record<string, unknown>, plan, alarm);
  assert.equal(kind(undefined).kind, "unknown");
  assert.equal(kind({ op_mode: 0 }).text, "at rest");
  assert.equal(kind({ op_mode: 4 }).text, "on autopilot");
  assert.equal(kind({ op_mode: 3, maneuver_type: 452 }).text, "by hand");
  assert.equal(kind({ op_mode: 2 }).text, "aborted");
  const plan = { state: 3, plan_id: "square", man_id: "Goto 2" };
  assert.deepEqual(kind({ op_mode: 3, maneuver_type: 450 }, plan), {
    kind: "plan",
    text: "plan square: Goto 2",
    mood: "good",
    maneuver: "Goto 2",
  });
  assert.equal(kind({ op_mode: 4 }, {}, "operator_lost").text, "comes up: operator lost");
});

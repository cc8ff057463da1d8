import assert from "node:assert/strict";
import { test } from "node:test";
import { Goals, limits, nextSwitch, StateSwitch, stickPlan } from "../src/desk.ts";
import { deadZone, StickReader, withDeadZone, wrapped } from "../src/sticks.ts";

const centred = { roll: 0, pitch: 0, turn: 0, climb: 0 };
const known = { x: 1, y: -2, altitude: 0.9, yaw: 7, position: true, flies: true };

test("a stick near its centre is centred, and at its end is full", () => {
  assert.equal(withDeadZone(deadZone * 0.99), 0);
  assert.equal(withDeadZone(-1), -1);
  assert.equal(withDeadZone(NaN), 0);
  assert.ok(Math.abs(withDeadZone(0.54) - 0.5) < 1e-9);
});

test("who takes over changes nothing: goals are where the vehicle is", () => {
  const goals = new Goals();
  goals.adopt(known);
  assert.deepEqual(goals.command(centred, true), { roll: -2000, pitch: 1000, yaw: Math.round((7 - 2 * Math.PI) * 1000), z: 900 });
  goals.adopt({ ...known, flies: false });
  assert.equal(goals.altitude, 0);
});

test("by hand sticks lean it, to the right and nose down for forward, and centred they do not", () => {
  const goals = new Goals();
  assert.deepEqual(goals.command({ ...centred, roll: 1, pitch: 1 }, false), { roll: 150, pitch: -150, yaw: 0, z: 0 });
  assert.deepEqual(goals.command(centred, false), { roll: 0, pitch: 0, yaw: 0, z: 0 });
});

test("where position is held sticks move it along the nose, as far as it may go", () => {
  const goals = new Goals();
  goals.adopt({ ...known, x: 0, y: 0, yaw: Math.PI / 2 });
  goals.move({ ...centred, pitch: 1 }, 1, true);
  assert.ok(Math.abs(goals.x) < 1e-9 && Math.abs(goals.y - limits.speed) < 1e-9, "forward is east");
  goals.move({ ...centred, roll: 1 }, 1, true);
  assert.ok(Math.abs(goals.x + limits.speed) < 1e-9, "right of east is south");
  goals.move({ ...centred, pitch: 1 }, 1e6, true);
  assert.equal(goals.y, limits.away);
  goals.move({ ...centred, pitch: 1 }, 1, false);
  assert.equal(goals.y, limits.away);
});

test("climb and turn keep within limits", () => {
  const goals = new Goals();
  goals.move({ ...centred, climb: 1 }, 100, false);
  assert.equal(goals.altitude, limits.altitude);
  goals.move({ ...centred, climb: -1 }, 100, false);
  assert.equal(goals.altitude, 0);
  goals.move({ ...centred, turn: 1 }, 5, false);
  assert.ok(Math.abs(goals.yaw - wrapped(4)) < 1e-9);
});

// What has the focus, in a page.
class Element {
  readonly what: string;
  constructor(what: string) {
    this.what = what;
  }
  closest(): null {
    return null;
  }
  matches(list: string): boolean {
    return list.split(", ").includes(this.what);
  }
}

test("a key moves its stick, and is left to what has the focus and to the browser's own", () => {
  Object.assign(globalThis, { HTMLElement: Element });
  const moved = (event: object) => {
    const input = new StickReader(stickPlan);
    let kept = false;
    input.keyDown({ code: "KeyW", target: new Element("button"), preventDefault: () => (kept = true), ...event } as never);
    assert.equal(kept, input.read().climb !== 0);
    return kept;
  };
  assert.ok(moved({}));
  assert.ok(!moved({ code: "KeyX" }));
  for (const held of ["ctrlKey", "metaKey", "altKey"]) assert.ok(!moved({ [held]: true }), held);
  for (const what of ["input", "select", "textarea", ".map"]) assert.ok(!moved({ target: new Element(what) }), what);
});

test("the newest of keys, pads and gamepad moves a stick, and all that is let go is centred", () => {
  const input = new StickReader(stickPlan);
  assert.deepEqual(input.read(), centred);
  input.press("ArrowRight");
  input.press("KeyS");
  input.press("KeyX");
  assert.deepEqual(input.read(), { ...centred, roll: 1, climb: -1 });
  input.press("ArrowLeft");
  assert.equal(input.read().roll, 0);
  input.lift("ArrowRight");
  assert.equal(input.read().roll, -1);
  input.letGo();
  assert.deepEqual(input.read(), centred);
  input.pads.pitch = 0.5;
  assert.equal(input.read([0, 0, 0, -1]).pitch, 1);
  assert.equal(input.read([0.02, 0, 0, 0]).pitch, 0.5);
});

test("the one key arms, takes off, lands, and acknowledges what nobody wanted", () => {
  assert.equal(nextSwitch("halt", "none"), "Arm");
  assert.equal(nextSwitch("ground", "none"), "Take off");
  assert.equal(nextSwitch("ground", "operator_lost"), "Acknowledge");
  assert.equal(nextSwitch("starting", "none"), "Stop");
  assert.equal(nextSwitch("flying", "none"), "Land");
  assert.equal(nextSwitch("landing", "none"), undefined);
});

test("a second press of what ends a flight does not undo the first, nor start motors", () => {
  const its = new StateSwitch();
  its.show("Stop", 1000);
  assert.equal(its.press(1000, 1), "Stop");
  // the page does not know yet, at any pace
  assert.equal(its.press(1100, 1.1), undefined);
  assert.equal(its.press(9000, 4.9), undefined);
  assert.equal(its.press(1500, 40), undefined);
  // it was faster, and lands
  its.show("Land", 1600);
  assert.equal(its.press(1700, 1.7), undefined);
  its.show(undefined, 1800);
  assert.equal(its.press(9000, 9), undefined);
  its.show("Take off", 10_000);
  assert.equal(its.press(10_599, 10), undefined);
  assert.equal(its.press(10_600, 10), "Take off");
});

test("what ends a flight counts at once, and again where nothing came of it", () => {
  const its = new StateSwitch();
  its.show("Land", 0);
  assert.equal(its.press(0, 10), "Land");
  its.show("Land", 50);
  assert.equal(its.press(60_000, 13.9), undefined);
  assert.equal(its.press(60_000, 14), "Land");
  // at once if jarol has refused it
  assert.equal(its.press(60_100, 14.1), undefined);
  its.forget();
  assert.equal(its.press(60_100, 14.1), "Land");
});

test("what was told to take off can be ended before it says that it does, what was shut down is not armed by that", () => {
  const its = new StateSwitch();
  its.show("Take off", 0);
  assert.equal(its.isStarting, false);
  assert.equal(its.press(600, 1), "Take off");
  assert.equal(its.isStarting, true);
  its.show("Stop", 700);
  assert.equal(its.press(700, 1.1), "Stop");
  its.show("Land", 800);
  its.wait(5000, 9); // SHUT_DOWN
  assert.equal(its.press(5100, 9.1), undefined);
  its.show("Arm", 5200);
  assert.equal(its.press(5300, 9.2), undefined);
});

import assert from "node:assert/strict";
import { test } from "node:test";
import * as three from "three";
import { modelOf } from "../src/scene.ts";

// bottom, port, starboard, top, as the simulation numbers them
function trailingEdges(angles: readonly number[]): three.Vector3[] {
  const model = modelOf("submarine");
  model.move([0, ...angles], 0.01);
  model.group.updateMatrixWorld(true);
  const fins = model.group.children.filter((part) => part.type === "Group" && Math.abs(part.position.x + 0.46) < 1e-9);
  return fins.map((fin) => fin.localToWorld(new three.Vector3(-0.05, 0, 0)).sub(fin.position));
}

test("fins turn as they lift: a positive angle takes the trailing edge to port, or down, and the tail to starboard, or up", () => {
  const [bottom, port, starboard, top] = trailingEdges([0.4, 0.4, 0.4, 0.4]) as [three.Vector3, three.Vector3, three.Vector3, three.Vector3];
  for (const rudder of [bottom, top]) {
    assert.ok(rudder.y < -0.005, `${rudder.y}`);
    assert.ok(Math.abs(rudder.z) < 1e-9);
  }
  for (const plane of [port, starboard]) {
    assert.ok(plane.z > 0.005, `${plane.z}`);
    assert.ok(Math.abs(plane.y) < 1e-9);
  }
});

import assert from "node:assert/strict";
import { test } from "node:test";
import { latLonOf, spotOf } from "../src/geodesy.ts";
import { snapped } from "../src/map.ts";
import { check, drawingOf, drawingOfDraft, lengthOf, specificationOf, type Kind, type Maneuver } from "../src/plan.ts";
import type { Fields } from "../src/protocol.ts";
// tests/distributers/lauv/maneuvers_test.cpp has the vehicle's geodesy agree with the same places
import places from "./places.json";

const origin = { lat: 0.7188138524338646, lon: -0.15195185533713032 };
const limits = { depth: 11, speed: 1.6 };
function maneuver(kind: Kind, spots: [number, number][], changes: Partial<Maneuver> = {}): Maneuver {
  return { kind, spots, depth: 3, speed: 1.2, radius: 15, duration: 60, ...changes };
}
const square = ([[60, 0], [60, 60], [0, 60], [0, 0]] as const).map((spot) => maneuver("Goto", [[...spot]]));
const texts = (plan: Maneuver[], name = "p") => check(name, plan, limits).map(({ text, maneuver: at }) => `${at ?? "-"}: ${text}`);
type Inline = { abbrev: string; fields: Fields };

test("a place is where the vehicle has it, there and back", () => {
  assert.equal(places.length, 7);
  for (const { origin: from, north, east, lat, lon } of places) {
    const place = latLonOf([north, east], from);
    assert.ok(Math.abs(place.lat - lat) < 1e-15 && Math.abs(place.lon - lon) < 1e-15);
    const [n, e] = spotOf({ lat, lon }, from);
    // a rounding of the angle is some nanometres
    assert.ok(Math.abs(n - north) < 1e-8 && Math.abs(e - east) < 1e-8, `${n} ${e}`);
    assert.ok(Math.abs(spotOf({ lat, lon: lon - 2 * Math.PI }, from)[1] - east) < 1e-8, "longitudes go round");
  }
});

test("places on the map are round at its scale", () => {
  const frame = { north: 0, east: 0, scale: 3, width: 300, height: 200 };
  assert.deepEqual(snapped(frame, [59.2, -0.7]), [60, 0]);
  assert.deepEqual(snapped({ ...frame, scale: 100 }, [1.234, -2.26]), [1.25, -2.25]);
});

test("a square of 60 m is good, 240 m long, and 200 s at 1.2 m/s", () => {
  assert.deepEqual(texts(square), []);
  const { metres, seconds } = lengthOf(square);
  assert.equal(metres, 240);
  assert.ok(Math.abs(seconds - 200) < 1e-9);
});

test("circles and stations take their time", () => {
  const { metres, seconds } = lengthOf([maneuver("Goto", [[12, 0]]), maneuver("Loiter", [[12, 0]]), maneuver("StationKeeping", [[12, 0]])]);
  assert.ok(Math.abs(metres - 84) < 1e-9 && Math.abs(seconds - 130) < 1e-9);
});

test("what can't be flown is said, and of which maneuver", () => {
  assert.deepEqual(texts([], " "), ["-: the plan has no name", "-: there is no maneuver; choose one and press on the map"]);
  assert.deepEqual(texts(square, "x".repeat(41)), ["-: the plan's name has more than 40 characters"]);
  assert.deepEqual(texts([maneuver("Goto", [[60, 0]], { depth: 12, speed: 0.2 })]), [
    "0: depth from 0 to 11 m",
    "0: speed from 0.5 to 1.6 m/s",
  ]);
  assert.deepEqual(texts([maneuver("Loiter", [[60, 0]], { radius: 5, duration: 1.5 })]), [
    "0: radius from 10 to 500 m",
    "0: time in whole seconds",
  ]);
  assert.deepEqual(texts([maneuver("Loiter", [[60, 0]], { duration: 0 }), maneuver("Surface", [])]), [
    "0: it has no end, so that nothing after it is flown",
  ]);
  assert.deepEqual(texts([maneuver("FollowPath", [[60, 0]])]), ["0: a path has at least two corners"]);
  assert.deepEqual(texts([maneuver("Goto", [[NaN, 0]])]), ["0: places are numbers"]);
  assert.deepEqual(texts([maneuver("Goto", [[6000, 0]])]), ["0: places are within 5 km of home"]);
  assert.deepEqual(texts([maneuver("Goto", [[60, 0]], { depth: NaN })]), ["0: depth from 0 to 11 m"]);
  assert.equal(texts(Array.from({ length: 41 }, (_, i) => maneuver("Goto", [[i * 60, 0]]))).length, 1);
});

test("places too near to turn in are said, and can be flown all the same", () => {
  const near = [maneuver("Goto", [[60, 0]]), maneuver("Goto", [[60, 5]])];
  assert.deepEqual(check("p", near, limits), [
    { text: "less than 20 m from the place before: too near to turn in", maneuver: 1, mild: true },
  ]);
});

test("a plan is a PlanSpecification, flown from first to last", () => {
  const { abbrev, fields } = specificationOf("square", square, origin);
  assert.equal(abbrev, "PlanSpecification");
  assert.equal(fields["plan_id"], "square");
  assert.equal(fields["start_man_id"], "Goto 1");
  const maneuvers = fields["maneuvers"] as Inline[];
  assert.deepEqual(maneuvers.map((one) => one.fields["maneuver_id"]), ["Goto 1", "Goto 2", "Goto 3", "Goto 4"]);
  const { lat, lon } = latLonOf([60, 60], origin);
  assert.deepEqual(maneuvers[1]!.fields["data"], {
    abbrev: "Goto",
    fields: { lat, lon, speed: 1.2, speed_units: "METERS_PS", z: 3, z_units: "DEPTH" },
  });
  assert.deepEqual((fields["transitions"] as Inline[]).map((one) => one.fields), [
    { source_man: "Goto 1", dest_man: "Goto 2", conditions: "ManeuverIsDone" },
    { source_man: "Goto 2", dest_man: "Goto 3", conditions: "ManeuverIsDone" },
    { source_man: "Goto 3", dest_man: "Goto 4", conditions: "ManeuverIsDone" },
  ]);
});

test("a path goes by its first corner, Surface is an Elevator where it is", () => {
  const { fields } = specificationOf("p", [maneuver("FollowPath", [[10, 20], [40, 20], [40, 50]]), maneuver("Surface", [])], origin);
  const [path, up] = (fields["maneuvers"] as Inline[]).map((one) => one.fields["data"] as Inline);
  assert.deepEqual((path!.fields["points"] as Inline[]).map((one) => one.fields), [
    { x: 0, y: 0, z: 0 },
    { x: 30, y: 0, z: 0 },
    { x: 30, y: 30, z: 0 },
  ]);
  assert.equal(up!.abbrev, "Elevator");
  assert.deepEqual(up!.fields["flags"], ["CURR_POS"]);
  assert.equal(up!.fields["end_z"], 0);
});

test("what the vehicle has is drawn where it was drawn", () => {
  const plan = [
    maneuver("Goto", [[60, 0]]),
    maneuver("FollowPath", [[10, 20], [40, 20]]),
    maneuver("Loiter", [[5, 5]]),
    maneuver("StationKeeping", [[-5, 5]], { radius: 20 }),
    maneuver("Surface", []),
  ];
  const specification = specificationOf("p", plan, origin).fields;
  // as the vehicle answers: bits as a number
  const elevator = (specification["maneuvers"] as Inline[])[4]!.fields["data"] as Inline;
  elevator.fields["flags"] = 1;
  const drawn = drawingOf(specification, origin);
  assert.equal(drawn.length, 5);
  drawingOfDraft(plan).forEach(({ name, spots, radius }, i) => {
    assert.equal(drawn[i]!.name, name);
    assert.equal(drawn[i]!.radius, radius);
    assert.equal(drawn[i]!.spots.length, spots.length);
    spots.forEach(([n, e], corner) => {
      const [north, east] = drawn[i]!.spots[corner]!;
      assert.ok(Math.abs(north - n) < 1e-8 && Math.abs(east - e) < 1e-8);
    });
  });
  assert.deepEqual(drawingOf({ maneuvers: [null, {}] } as Fields, origin), []);
});

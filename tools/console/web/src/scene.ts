// The vehicle in three dimensions, of simple solids: in NED axes, one metre a unit.

import * as three from "three";
import type { VehicleKind } from "./vehicles.ts";

export interface Model {
  group: three.Group;
  /** Parts of full actuation, in the order of the vehicle's actuators; seconds that went by. */
  move(parts: readonly number[], seconds: number): void;
  size: number;
}

function solid(geometry: three.BufferGeometry, colour: number): three.Mesh {
  return new three.Mesh(geometry, new three.MeshPhongMaterial({ color: colour, specular: 0x444444, shininess: 50 }));
}

// Fins as the LAUV numbers them: bottom, port, starboard, top.
function submarine(): Model {
  const group = new three.Group();
  const radius = 0.075;
  const hull = solid(new three.CapsuleGeometry(radius, 0.95, 10, 24), 0xf0b323);
  hull.rotation.z = Math.PI / 2;
  group.add(hull);
  const nose = solid(new three.SphereGeometry(radius * 1.004, 28, 16, 0, Math.PI), 0x1d242e);
  nose.rotation.y = Math.PI / 2;
  nose.position.x = 0.475;
  group.add(nose);
  // where its sections are joined
  for (const [x, width, colour] of [[0.47, 0.03, 0x1d242e], [0.2, 0.012, 0x2b3442], [-0.16, 0.012, 0x2b3442], [-0.4, 0.05, 0x1d242e]] as const) {
    const ring = solid(new three.CylinderGeometry(radius * 1.012, radius * 1.012, width, 32), colour);
    ring.rotation.z = Math.PI / 2;
    ring.position.x = x;
    group.add(ring);
  }
  const sonar = solid(new three.BoxGeometry(0.12, 0.03, 0.03), 0x1d242e);
  sonar.position.set(0.3, 0, radius);
  group.add(sonar);
  const antenna = solid(new three.CylinderGeometry(0.006, 0.006, 0.2), 0x30343c);
  antenna.rotation.x = Math.PI / 2;
  antenna.position.set(0.1, 0, -0.15);
  group.add(antenna);
  const mast = solid(new three.BoxGeometry(0.07, 0.02, 0.07), 0x1d242e);
  mast.position.set(0.1, 0, -0.1);
  group.add(mast);
  const fins = [
    [0, 1],
    [-1, 0],
    [1, 0],
    [0, -1],
  ].map(([y, z]) => {
    const fin = new three.Group();
    const blade = solid(new three.BoxGeometry(0.1, y === 0 ? 0.014 : 0.13, y === 0 ? 0.13 : 0.014), 0xb8401f);
    blade.position.set(0, y! * 0.06, z! * 0.06);
    fin.add(blade);
    fin.position.set(-0.46, y! * radius * 0.8, z! * radius * 0.8);
    group.add(fin);
    return fin;
  });
  const propeller = new three.Group();
  propeller.position.x = -0.575;
  for (let i = 0; i < 3; ++i) {
    const blade = solid(new three.BoxGeometry(0.012, 0.03, 0.1), 0x3a4352);
    const arm = new three.Group();
    blade.position.z = 0.05;
    blade.rotation.z = 0.6;
    arm.add(blade);
    arm.rotation.x = (i * 2 * Math.PI) / 3;
    propeller.add(arm);
  }
  group.add(propeller);
  return {
    group,
    size: 1.1,
    move(parts, seconds) {
      propeller.rotation.x += (parts[0] || 0) * 40 * seconds;
      // a positive angle lifts the tail to starboard, or up: the trailing edge goes to port, or down
      fins.forEach((fin, i) => {
        const angle = (parts[i + 1] || 0) * 0.5;
        if (i === 0 || i === 3) fin.rotation.z = angle;
        else fin.rotation.y = angle;
      });
    },
  };
}

// Rotors as the JAviator numbers them: front, right, rear, left.
function helicopter(): Model {
  const group = new three.Group();
  const arm = 0.4;
  const hub = solid(new three.CylinderGeometry(0.085, 0.085, 0.09, 24), 0x2b3442);
  hub.rotation.x = Math.PI / 2;
  group.add(hub);
  const dome = solid(new three.SphereGeometry(0.075, 24, 12), 0x3f74b5);
  dome.scale.z = 0.6;
  dome.position.z = -0.05;
  group.add(dome);
  const rotors = [0, 1, 2, 3].map((i) => {
    const angle = (i * Math.PI) / 2;
    const tube = solid(new three.CylinderGeometry(0.011, 0.011, arm), i === 0 ? 0xd1492e : 0x59626f);
    tube.position.set((Math.cos(angle) * arm) / 2, (Math.sin(angle) * arm) / 2, 0);
    tube.rotation.z = angle - Math.PI / 2;
    group.add(tube);
    const motor = solid(new three.CylinderGeometry(0.022, 0.026, 0.05, 16), 0x1e252f);
    motor.rotation.x = Math.PI / 2;
    motor.position.set(Math.cos(angle) * arm, Math.sin(angle) * arm, -0.01);
    group.add(motor);
    const foot = solid(new three.CylinderGeometry(0.006, 0.006, 0.16), 0x59626f);
    foot.rotation.x = Math.PI / 2;
    foot.position.set(Math.cos(angle) * arm * 0.92, Math.sin(angle) * arm * 0.92, 0.09);
    group.add(foot);
    const rotor = new three.Group();
    rotor.position.set(Math.cos(angle) * arm, Math.sin(angle) * arm, -0.05);
    const blades = solid(new three.BoxGeometry(0.35, 0.022, 0.004), 0xd8dde5);
    rotor.add(blades);
    const disc = new three.Mesh(
      new three.CircleGeometry(0.18, 40),
      new three.MeshBasicMaterial({ color: 0x9fb4cc, transparent: true, opacity: 0, side: three.DoubleSide }),
    );
    rotor.add(disc);
    group.add(rotor);
    return { rotor, disc, way: i % 2 === 0 ? 1 : -1 };
  });
  return {
    group,
    size: 1.0,
    move(parts, seconds) {
      rotors.forEach(({ rotor, disc, way }, i) => {
        const part = Math.max(0, parts[i] || 0);
        rotor.rotation.z += way * part * 60 * seconds;
        disc.material.opacity = Math.min(0.35, part * 0.6);
      });
    },
  };
}

export function modelOf(kind: VehicleKind): Model {
  return kind === "submarine" ? submarine() : helicopter();
}

/** A group whose children stand in NED axes, in a scene whose y points up and whose -z points north. */
export function northEastDown(): three.Group {
  const group = new three.Group();
  group.matrixAutoUpdate = false;
  group.matrix.set(0, 1, 0, 0, 0, 0, -1, 0, -1, 0, 0, 0, 0, 0, 0, 1);
  return group;
}

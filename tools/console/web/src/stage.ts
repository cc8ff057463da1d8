// The vehicle, its path and what is around it, drawn in three dimensions at an instant.

import * as three from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { modelOf, northEastDown } from "./scene.ts";
import type { Store } from "./series.ts";
import { Dome, Drift, flowArrow, grains, pad, ripples, shadow } from "./surroundings.ts";
import { Trail } from "./trail.ts";
import { poseAt, type Flow, type Pose, type Vehicle } from "./vehicles.ts";

export type Camera = "follow" | "overview";

// Metres of the sheets of sea, ground and floor, and of a tile of their pattern.
const wide = 240;
const tile = 6;
// Metres below a submarine at which the floor is not seen any more.
const farDown = 12;
// Of a helicopter's feet below its middle.
const ground = 0.17;

interface Sheet {
  group: three.Group;
  surface: three.MeshBasicMaterial;
  grid: three.LineBasicMaterial;
  name: string;
}

// Without a graphics processor every picture costs what the rest of the page lacks.
function isSoftware(): boolean {
  const gl = document.createElement("canvas").getContext("webgl2");
  const info = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = String(info ? gl?.getParameter(info.UNMASKED_RENDERER_WEBGL) : "");
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
}

export class Stage {
  camera: Camera = "follow";
  private readonly vehicle: Vehicle;
  private readonly store: Store;
  private readonly software: boolean;
  private readonly renderer: three.WebGLRenderer;
  private readonly scene = new three.Scene();
  private readonly eye = new three.PerspectiveCamera(42, 1, 0.05, 2000);
  private readonly controls: OrbitControls;
  private readonly ned = northEastDown();
  private readonly model;
  private readonly wet: boolean;
  private readonly sheets: Sheet[] = [];
  private readonly floor: three.Group | undefined;
  private readonly trails: { trail: Trail; name: string }[] = [];
  private readonly plumb: three.Line;
  private readonly shade = shadow();
  private readonly drift: Drift | undefined;
  private readonly arrow = flowArrow();
  private readonly fog: three.Fog;
  private readonly sized: ResizeObserver;
  private readonly dome = new Dome();
  private theme = "";
  /** Of air and of water; undefined: it is not painted yet. */
  private skies: Record<"above" | "below", { zenith: three.Color; haze: three.Color; nadir: three.Color }> | undefined;
  private under: "above" | "below" | "" = "";
  private pose: Pose = { x: 0, y: 0, down: 0, roll: 0, pitch: 0, heading: 0, speed: 0 };
  private instant = 0;
  private compiled = false;
  private turning = false;
  private waiting = 0;
  private free = 0;
  private last = performance.now();

  /** Throws where the browser has no WebGL. */
  constructor(box: HTMLElement, vehicle: Vehicle, store: Store, flow: Flow | undefined) {
    this.vehicle = vehicle;
    this.store = store;
    this.wet = vehicle.kind === "submarine";
    this.renderer = new three.WebGLRenderer({ antialias: !isSoftware() });
    this.software = !this.renderer.getContext().getContextAttributes()?.antialias;
    const canvas = this.renderer.domElement;
    box.append(canvas);
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", `the ${vehicle.kind} and its path`);
    this.renderer.setPixelRatio(this.software ? 1 : Math.min(2, devicePixelRatio));
    this.controls = new OrbitControls(this.eye, canvas);
    this.controls.enableDamping = false;
    this.controls.addEventListener("change", () => this.turning || this.render());

    const sun = new three.DirectionalLight(0xffffff, 2.4);
    sun.position.set(4, 9, 5);
    this.scene.add(this.dome.mesh, this.ned, sun, new three.HemisphereLight(0xe6f2ff, 0x6a6f60, 1.7));
    this.model = modelOf(vehicle.kind);
    this.model.group.rotation.order = "ZYX";
    this.ned.add(this.model.group);
    this.fog = new three.Fog(0);
    this.scene.fog = this.fog;

    // the surface of the sea or the ground at zero, and the floor where it is known
    const surface = this.addSheet(this.wet ? "--scene-water" : "--scene-ground", this.wet ? ripples() : grains(), this.wet ? 0.42 : 1);
    this.floor = this.wet && vehicle.floor ? this.addSheet("--scene-floor", grains(), 1) : undefined;
    if (this.wet) {
      this.drift = new Drift();
      this.ned.add(this.drift.points);
    } else {
      surface.position.z = ground;
      const home = pad();
      home.position.z = ground - 0.008;
      this.ned.add(home);
    }
    this.ned.add(this.shade);
    for (const [place, name] of [[vehicle.estimate, "--accent"], [vehicle.truth, "--truth"]] as const) {
      if (!place) continue;
      const trail = new Trail(place);
      this.trails.push({ trail, name });
      this.ned.add(trail.line);
    }
    // from the vehicle straight to zero: how deep or high it is
    this.plumb = new three.Line(
      new three.BufferGeometry().setFromPoints([new three.Vector3(), new three.Vector3()]),
      new three.LineDashedMaterial({ dashSize: 0.12, gapSize: 0.09, transparent: true, opacity: 0.8 }),
    );
    this.plumb.frustumCulled = false;
    this.ned.add(this.plumb);
    const speed = flow ? Math.hypot(flow.north, flow.east) : 0;
    this.arrow.visible = flow !== undefined && speed > 0;
    if (flow) {
      this.arrow.rotation.z = Math.atan2(flow.east, flow.north);
      this.arrow.scale.setScalar(Math.min(2, 0.5 + speed / (this.wet ? 0.5 : 4)));
    }
    this.ned.add(this.arrow);

    this.sized = new ResizeObserver(() => {
      this.renderer.setSize(box.clientWidth, box.clientHeight);
      this.eye.aspect = box.clientWidth / Math.max(1, box.clientHeight);
      this.eye.updateProjectionMatrix();
      for (const { trail } of this.trails) trail.material.resolution.set(box.clientWidth, box.clientHeight);
      // what was drawn is gone
      this.free = 0;
      this.show(this.instant);
    });
    this.sized.observe(box);
    // programs of the graphics processor are made aside, while the rest of the page goes on
    void this.renderer.compileAsync(this.scene, this.eye).then(() => {
      this.compiled = true;
      this.show(this.instant);
    });
  }

  private addSheet(name: string, map: three.Texture, opacity: number): three.Group {
    map.repeat.set(wide / tile, wide / tile);
    const surface = new three.MeshBasicMaterial({ map, transparent: opacity < 1, opacity, side: three.DoubleSide, depthWrite: opacity === 1 });
    const grid = new three.GridHelper(wide, wide / (this.wet ? 5 : 2));
    const lines = grid.material as three.LineBasicMaterial;
    Object.assign(lines, { transparent: true, opacity: this.wet ? 0.22 : 0.4, vertexColors: false });
    grid.rotation.x = Math.PI / 2;
    grid.position.z = -0.005;
    const group = new three.Group();
    group.add(new three.Mesh(new three.PlaneGeometry(wide, wide), surface), grid);
    this.ned.add(group);
    this.sheets.push({ group, surface, grid: lines, name });
    return group;
  }

  /** In the colours that the page has now. */
  paint(theme: string): void {
    this.theme = theme;
    const style = getComputedStyle(document.documentElement);
    const css = (name: string) => style.getPropertyValue(name).trim();
    const colour = (name: string) => new three.Color(css(name));
    this.skies = {
      above: { zenith: colour("--scene-zenith"), haze: colour("--scene-sky"), nadir: colour("--scene-sky") },
      below: { zenith: colour("--scene-shallow"), haze: colour("--scene-deep"), nadir: colour("--scene-abyss") },
    };
    this.under = "";
    for (const { surface, grid, name } of this.sheets) {
      surface.color = colour(name);
      grid.color = colour("--text");
    }
    for (const { trail, name } of this.trails) trail.material.color = colour(name);
    (this.plumb.material as three.LineDashedMaterial).color = colour("--text");
    this.show(this.instant);
  }

  show(instant: number): void {
    this.instant = instant;
    const { vehicle, store, model } = this;
    this.pose =
      (vehicle.truth && poseAt(store, vehicle.truth, instant)) ??
      (vehicle.estimate && poseAt(store, vehicle.estimate, instant)) ??
      this.pose;
    const { x, y, down, roll, pitch, heading } = this.pose;
    model.group.position.set(x, y, down);
    model.group.rotation.set(roll, pitch, heading);
    const now = performance.now();
    model.move(vehicle.actuators.map(({ signal, max }) => store.number(signal, instant) / max), Math.min(0.1, (now - this.last) / 1000));
    this.last = now;
    // patterns and grids stay where they are in the world
    for (const { group } of this.sheets) group.position.set(Math.round(x / 30) * 30, Math.round(y / 30) * 30, group.position.z);
    const height = this.floor && vehicle.floor ? store.number(vehicle.floor, instant) : NaN;
    if (this.floor) {
      // what is further down is lost in the dark
      this.floor.visible = height < farDown;
      if (this.floor.visible) this.floor.position.z = down + height;
    }
    this.shade.visible = !this.wet || height < farDown;
    this.shade.position.set(x, y, (this.wet ? down + height : ground) - 0.012);
    this.drift?.surround(x, y, down);
    this.arrow.position.set(x - Math.cos(this.arrow.rotation.z) * 0.5, y - Math.sin(this.arrow.rotation.z) * 0.5, this.wet ? Math.min(down - 0.55, 0) : down - 0.6);
    const ends = this.plumb.geometry.getAttribute("position") as three.BufferAttribute;
    ends.setXYZ(0, x, y, down);
    ends.setXYZ(1, x, y, this.wet ? 0 : ground);
    ends.needsUpdate = true;
    this.plumb.computeLineDistances();
    for (const { trail } of this.trails) trail.place(store, instant);
    this.aim();
    this.render();
  }

  private aimed: Camera | "" = "";
  private seenSize = 0;
  private readonly before = new three.Vector3();
  private aim(): void {
    const { controls, eye } = this;
    if (this.aimed !== this.camera) this.seenSize = 0;
    if (this.camera === "overview") {
      this.overview();
    } else {
      const target = new three.Vector3(this.pose.x, this.pose.y, this.pose.down).applyMatrix4(this.ned.matrix);
      if (this.aimed !== "follow") {
        controls.target.copy(target);
        eye.position.copy(target).add(new three.Vector3(-1.35, 0.62, 1.75).multiplyScalar(this.model.size * 1.05));
      } else {
        eye.position.add(target).sub(this.before);
        controls.target.copy(target);
      }
      this.before.copy(target);
    }
    this.aimed = this.camera;
    this.turning = true;
    controls.update();
    this.turning = false;
  }

  // All of the path; it moves only when that has grown out of sight.
  private overview(): void {
    const bounds = new three.Box3();
    for (const { trail } of this.trails) bounds.union(trail.bounds.clone().applyMatrix4(this.ned.matrix));
    if (bounds.isEmpty()) return;
    const size = Math.max(this.model.size * 2, bounds.getSize(new three.Vector3()).length());
    if (size < this.seenSize * 1.1) return;
    this.seenSize = size * 1.15;
    bounds.getCenter(this.controls.target);
    this.eye.position.copy(this.controls.target).add(new three.Vector3(-0.6, 0.5, 0.7).multiplyScalar(size * 1.2));
  }

  private readonly pixel = new Uint8Array(4);
  // At most a quarter of the time goes into pictures: the next one waits.
  private render(): void {
    const begun = performance.now();
    if (!this.compiled || !this.skies) return;
    if (begun < this.free) {
      this.waiting ||= window.setTimeout(() => {
        this.waiting = 0;
        this.show(this.instant);
      }, this.free - begun);
      return;
    }
    const under = this.wet && this.eye.position.y < 0 ? "below" : "above";
    if (under !== this.under) {
      this.under = under;
      const { zenith, haze, nadir } = this.skies[under];
      this.dome.paint(zenith, haze, nadir);
      this.fog.color = haze;
      [this.fog.near, this.fog.far] = under === "below" ? [9, 42] : [22, 95];
    }
    this.dome.mesh.position.copy(this.eye.position);
    this.renderer.render(this.scene, this.eye);
    // what is drawn by now, for who takes pictures
    Object.assign(this.renderer.domElement.dataset, { instant: String(this.instant), theme: this.theme });
    if (this.software) {
      // waits until the picture is made, which finish() does not where another process makes it
      const gl = this.renderer.getContext();
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, this.pixel);
    }
    const cost = performance.now() - begun;
    this.free = cost > 12 ? performance.now() + 3 * cost : 0;
  }

  dispose(): void {
    clearTimeout(this.waiting);
    this.sized.disconnect();
    this.controls.dispose();
    this.renderer.dispose();
  }
}

// What is around the vehicle in three dimensions: sky or water, ground, sea surface and floor. Colours come from the page's
// style, patterns from numbers that are the same every time.

import * as three from "three";

/** Numbers from 0 to 1, the same every time. */
function numbers(seed: number): () => number {
  let state = seed;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 4294967296;
  };
}

function canvasOf(width: number, height: number): [HTMLCanvasElement, CanvasRenderingContext2D] {
  const canvas = document.createElement("canvas");
  canvas.width = width;
  canvas.height = height;
  return [canvas, canvas.getContext("2d")!];
}

/** Sky or water as far as one sees: around whoever looks, from straight up over the haze at the horizon to straight down. */
export class Dome {
  readonly mesh: three.Mesh;
  private readonly geometry = new three.SphereGeometry(900, 24, 48);

  constructor() {
    const count = this.geometry.getAttribute("position").count;
    this.geometry.setAttribute("color", new three.BufferAttribute(new Float32Array(count * 3), 3));
    this.mesh = new three.Mesh(
      this.geometry,
      new three.MeshBasicMaterial({ vertexColors: true, side: three.BackSide, fog: false, depthWrite: false }),
    );
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = -1;
  }

  paint(zenith: three.Color, haze: three.Color, nadir: three.Color): void {
    const place = this.geometry.getAttribute("position");
    const colour = this.geometry.getAttribute("color") as three.BufferAttribute;
    const mixed = new three.Color();
    for (let i = 0; i < place.count; ++i) {
      const up = place.getY(i) / 900;
      mixed.copy(haze).lerp(up > 0 ? zenith : nadir, Math.min(1, 1.6 * Math.abs(up) ** 0.7));
      colour.setXYZ(i, mixed.r, mixed.g, mixed.b);
    }
    colour.needsUpdate = true;
  }
}

/** Grains as of sand or grass, in shades of white, to be multiplied with a colour. */
export function grains(): three.Texture {
  const [canvas, context] = canvasOf(256, 256);
  const next = numbers(7);
  context.fillStyle = "#e8e8e8";
  context.fillRect(0, 0, 256, 256);
  for (let i = 0; i < 1600; ++i) {
    const shade = 214 + Math.floor(next() * 40);
    context.fillStyle = `rgb(${shade} ${shade} ${shade} / 0.45)`;
    const size = 2 + next() * 7;
    context.fillRect(next() * 256, next() * 256, size, size);
  }
  return tiled(canvas);
}

/** Crests of small waves. */
export function ripples(): three.Texture {
  const [canvas, context] = canvasOf(256, 256);
  const next = numbers(3);
  context.fillStyle = "#d8d8d8";
  context.fillRect(0, 0, 256, 256);
  context.lineCap = "round";
  for (let i = 0; i < 90; ++i) {
    const [x, y, length] = [next() * 256, next() * 256, 12 + next() * 34];
    context.strokeStyle = `rgb(255 255 255 / ${0.25 + next() * 0.6})`;
    context.lineWidth = 0.8 + next() * 1.6;
    for (const [dx, dy] of [[0, 0], [-256, 0], [256, 0], [0, -256], [0, 256]] as const) {
      context.beginPath();
      context.moveTo(x + dx, y + dy);
      context.quadraticCurveTo(x + dx + length / 2, y + dy - 5 - next() * 4, x + dx + length, y + dy);
      context.stroke();
    }
  }
  return tiled(canvas);
}

function tiled(canvas: HTMLCanvasElement): three.Texture {
  const texture = new three.CanvasTexture(canvas);
  texture.wrapS = texture.wrapT = three.RepeatWrapping;
  texture.colorSpace = three.SRGBColorSpace;
  texture.anisotropy = 4;
  return texture;
}

/** Where a helicopter starts: a disc with an H. */
export function pad(): three.Mesh {
  const [canvas, context] = canvasOf(256, 256);
  context.fillStyle = "#4b535e";
  context.beginPath();
  context.arc(128, 128, 127, 0, 7);
  context.fill();
  context.strokeStyle = "#f4f6f8";
  context.lineWidth = 12;
  context.beginPath();
  context.arc(128, 128, 104, 0, 7);
  context.stroke();
  context.lineWidth = 22;
  context.beginPath();
  for (const [x0, y0, x1, y1] of [[92, 72, 92, 184], [164, 72, 164, 184], [92, 128, 164, 128]] as const) {
    context.moveTo(x0, y0);
    context.lineTo(x1, y1);
  }
  context.stroke();
  const map = new three.CanvasTexture(canvas);
  map.colorSpace = three.SRGBColorSpace;
  map.anisotropy = 4;
  return flat(new three.CircleGeometry(0.8, 48), new three.MeshBasicMaterial({ map, transparent: true }));
}

/** Under what flies, on the ground. */
export function shadow(): three.Mesh {
  const [canvas, context] = canvasOf(64, 64);
  const fill = context.createRadialGradient(32, 32, 4, 32, 32, 32);
  fill.addColorStop(0, "rgb(0 0 0 / 0.5)");
  fill.addColorStop(1, "rgb(0 0 0 / 0)");
  context.fillStyle = fill;
  context.fillRect(0, 0, 64, 64);
  return flat(
    new three.CircleGeometry(0.62, 32),
    new three.MeshBasicMaterial({ map: new three.CanvasTexture(canvas), transparent: true, depthWrite: false }),
  );
}

// Seen from above in NED axes, in which z points down.
function flat(geometry: three.BufferGeometry, material: three.Material): three.Mesh {
  const mesh = new three.Mesh(geometry, material);
  mesh.rotation.set(Math.PI, 0, Math.PI / 2);
  return mesh;
}

/** Grains that drift in the water, so that one sees how it moves: always around the vehicle. */
export class Drift {
  readonly points: three.Points;
  private static readonly size = 10;
  private readonly places: number[][];

  constructor(count = 220) {
    const next = numbers(11);
    this.places = Array.from({ length: count }, () => [next(), next(), next()].map((part) => part * Drift.size));
    const geometry = new three.BufferGeometry();
    geometry.setAttribute("position", new three.BufferAttribute(new Float32Array(count * 3), 3));
    this.points = new three.Points(
      geometry,
      new three.PointsMaterial({ color: 0xffffff, size: 0.022, transparent: true, opacity: 0.5, depthWrite: false }),
    );
    this.points.frustumCulled = false;
  }

  /** None stands above the surface. */
  surround(x: number, y: number, down: number): void {
    const position = this.points.geometry.getAttribute("position") as three.BufferAttribute;
    const near = (place: number, middle: number) =>
      middle - Drift.size / 2 + ((((place - middle) % Drift.size) + Drift.size * 1.5) % Drift.size);
    this.places.forEach(([px, py, pz], i) =>
      position.setXYZ(i, near(px!, x), near(py!, y), Math.max(0.05, near(pz!, down))),
    );
    position.needsUpdate = true;
  }
}

/** An arrow along the ground or the surface: how fast water or air moves, as far as the run says. */
export function flowArrow(): three.Group {
  const group = new three.Group();
  const material = new three.MeshBasicMaterial({ color: 0xffffff, transparent: true, opacity: 0.85 });
  const shaft = new three.Mesh(new three.CylinderGeometry(0.018, 0.018, 1, 12), material);
  shaft.rotation.z = -Math.PI / 2;
  shaft.position.x = 0.5;
  const head = new three.Mesh(new three.ConeGeometry(0.06, 0.18, 16), material);
  head.rotation.z = -Math.PI / 2;
  head.position.x = 1.05;
  group.add(shaft, head);
  return group;
}

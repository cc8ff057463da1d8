// The path of a vehicle as a line of some width.

import * as three from "three";
import { Line2 } from "three/addons/lines/Line2.js";
import { LineGeometry } from "three/addons/lines/LineGeometry.js";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import type { Store } from "./series.ts";
import type { Place } from "./vehicles.ts";

const maxPoints = 4000;

export class Trail {
  readonly material = new LineMaterial({ linewidth: 2.6 });
  readonly line: Line2;
  /** In NED axes. */
  readonly bounds = new three.Box3();
  private readonly geometry = new LineGeometry();
  private readonly segments: three.InterleavedBuffer;
  private readonly of: Place;

  constructor(of: Place) {
    this.of = of;
    this.geometry.setPositions(new Float32Array(maxPoints * 3));
    this.segments = (this.geometry.getAttribute("instanceStart") as three.InterleavedBufferAttribute).data;
    this.line = new Line2(this.geometry, this.material);
    this.line.frustumCulled = false;
  }

  /** From the begin to that instant. */
  place(store: Store, instant: number): void {
    const { x, y, down, downSign } = this.of;
    const series = store.series[x.output]!;
    const count = series.at(instant) + 1;
    const stride = Math.max(1, Math.ceil(count / (maxPoints - 2)));
    const array = this.segments.array;
    const point = new three.Vector3();
    let points = 0;
    this.bounds.makeEmpty();
    // a segment has its begin and its end
    const add = (i: number) => {
      point.set(series.columns[x.leaf]![i]!, series.columns[y.leaf]![i]!, series.columns[down.leaf]![i]! * downSign);
      if (!Number.isFinite(point.x + point.y + point.z)) return;
      this.bounds.expandByPoint(point);
      if (points > 0) point.toArray(array, (points - 1) * 6 + 3);
      point.toArray(array, points * 6);
      ++points;
    };
    for (let i = 0; i < count && points < maxPoints - 2; i += stride) add(i);
    if (count > 0 && (count - 1) % stride !== 0) add(count - 1);
    this.geometry.instanceCount = Math.max(0, points - 1);
    this.segments.needsUpdate = true;
    this.line.visible = points > 1;
  }
}

import {type Color, type Group, LineSegments, Mesh, type Object3D} from 'three';
import {Line2} from 'three/addons/lines/Line2.js';
import {LineGeometry} from 'three/addons/lines/LineGeometry.js';
import {LineMaterial} from 'three/addons/lines/LineMaterial.js';

import {shared} from './materials';

export interface Stroke {
  readonly color: Color;
  readonly pixels: number;
  readonly dash_mm?: number;
  readonly seenThrough?: boolean; // drawn in front of everything
  readonly opacity?: number;
}

/** A line of a width in pixels through points x, y, z, x, y, z... */
export function line(points: readonly number[], stroke: Stroke): Line2 {
  const {color, pixels, seenThrough = false, opacity = 1} = stroke;
  const dash = Number((stroke.dash_mm ?? 0).toPrecision(2)); // rounded, lest each size of a figure has materials of its own
  const material = shared('line', [color.getHex(), pixels, dash, seenThrough, opacity], () => new LineMaterial({
    color: color.getHex(), linewidth: pixels, dashed: dash > 0, dashSize: dash || 1,
    gapSize: 0.7 * dash || 1, depthTest: !seenThrough, transparent: true, opacity,
  }));
  const drawn = new Line2(new LineGeometry().setPositions(points as number[]), material);
  if (dash > 0) drawn.computeLineDistances();
  drawn.renderOrder = seenThrough ? 20 : 5;
  return drawn;
}

export function closed(points: readonly number[]): number[] {
  return [...points, ...points.slice(0, 3)];
}

/** Frees what a group has drawn, but for its materials, which are shared, and empties it. */
export function cleared(group: Group): void {
  for (const child of [...group.children]) {
    group.remove(child);
    free(child);
  }
}

function free(object: Object3D): void {
  object.traverse((part) => {
    if (part instanceof Mesh || part instanceof LineSegments) part.geometry.dispose();
  });
}

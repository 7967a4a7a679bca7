import {type Color, type Group, LineSegments, Mesh, type Object3D, Quaternion} from 'three';
import {Line2} from 'three/addons/lines/Line2.js';
import {LineGeometry} from 'three/addons/lines/LineGeometry.js';
import {LineMaterial} from 'three/addons/lines/LineMaterial.js';
import {LineSegments2} from 'three/addons/lines/LineSegments2.js';
import {LineSegmentsGeometry} from 'three/addons/lines/LineSegmentsGeometry.js';

import {shared} from './materials';

export interface Stroke {
  readonly color: Color;
  readonly pixels: number;
  readonly dash_mm?: number;
  readonly seenThrough?: boolean; // drawn in front of everything
  readonly opacity?: number;
}

/** How much wider than its line a halo is. */
const rim_px = 3;

/** A line of a width in pixels through points x, y, z, x, y, z... */
export function line(points: readonly number[], stroke: Stroke): Line2 {
  const material = materialOf(stroke);
  const drawn = new Line2(new LineGeometry().setPositions(points as number[]), material);
  if (material.dashed) drawn.computeLineDistances();
  drawn.renderOrder = stroke.seenThrough ? 20 : 5;
  return drawn;
}

/** Lines between pairs of points. */
export function segments(ends: readonly number[], stroke: Stroke): LineSegments2 {
  const drawn = new LineSegments2(new LineSegmentsGeometry().setPositions(ends as number[]), materialOf(stroke));
  drawn.renderOrder = 5;
  return drawn;
}

function materialOf(stroke: Stroke): LineMaterial {
  const {color, pixels, seenThrough = false, opacity = 1} = stroke;
  const dash = Number((stroke.dash_mm ?? 0).toPrecision(2)); // rounded, lest each size of a figure has materials of its own
  return shared('line', [color.getHex(), pixels, dash, seenThrough, opacity], () => new LineMaterial({
    color: color.getHex(), linewidth: pixels, dashed: dash > 0, dashSize: dash || 1,
    gapSize: 0.7 * dash || 1, depthTest: !seenThrough, transparent: true, opacity,
  }));
}

/** The line, and beneath it a wider one of the paper's colour: so it is seen on whatever lies behind, and in its shade. */
export function haloed(points: readonly number[], stroke: Stroke, paper: Color): Line2[] {
  const drawn = line(points, stroke);
  const halo = new Line2(drawn.geometry, materialOf({...stroke, color: paper, pixels: stroke.pixels + rim_px, opacity: 0.8}));
  halo.renderOrder = drawn.renderOrder - 1;
  return [halo, drawn];
}

/** Has what is drawn in its own x and y face the camera in each picture, about its own place. */
export function facing<T extends Object3D>(drawn: T): T {
  const before = drawn.onBeforeRender;
  drawn.onBeforeRender = (...rest) => {
    const around = drawn.parent!.getWorldQuaternion(new Quaternion()).invert();
    drawn.quaternion.copy(around).multiply(rest[2].getWorldQuaternion(new Quaternion()));
    drawn.updateMatrixWorld();
    before.apply(drawn, rest);
  };
  return drawn;
}

/** A circle about the origin, in x and y. */
export function circleOf(radius: number, corners = 48): number[] {
  return Array.from({length: corners + 1}, (_, n) => {
    const angle = (2 * Math.PI * n) / corners;
    return [radius * Math.cos(angle), radius * Math.sin(angle), 0];
  }).flat();
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

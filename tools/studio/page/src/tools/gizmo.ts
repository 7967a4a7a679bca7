import {type Camera, Group, type Object3D, Plane, type Ray, Vector3} from 'three';

import {readInks} from '../view/inks';
import {cleared, line} from '../view/lines';
import type {Stage} from '../view/stage';

export type Part = 'shift' | 'x' | 'y' | 'z' | 'turn-x' | 'turn-y' | 'turn-z' | 'scale';

const axes = {x: new Vector3(1, 0, 0), y: new Vector3(0, 1, 0), z: new Vector3(0, 0, 1)};
const near_px = 9;
const gap = 24, tip = 84, arc = 58, knob = 82, ring = 9, circles = 130; // pixels from the middle, which stays free to be seen

/** The thing to grasp a place by: arrows shift it, arcs turn it, the square scales it. Its size on the screen is always the same. */
export class Gizmo {
  readonly group = new Group();
  #hot: Part | null = null;
  #parts: readonly Part[] = [];

  /** `wide`: with whole circles, for what is turned as a whole. */
  constructor(private readonly stage: Stage, parent: Object3D, private readonly wide = false) {
    parent.add(this.group);
    this.group.visible = false;
    stage.beforeDraw.add(() => this.#resize());
  }

  show(at: Vector3 | null, parts: readonly Part[]): void {
    const isNew = parts.join() !== this.#parts.join() || !this.group.visible;
    this.group.visible = at !== null;
    this.#parts = parts;
    if (at) this.group.position.copy(at);
    if (at && isNew) this.repaint();
    this.#resize();
    this.stage.invalidate();
  }

  repaint(): void {
    cleared(this.group);
    const inks = readInks();
    for (const part of this.#parts) {
      const hot = part === this.#hot, color = hot ? inks.accent : inks.ink;
      for (const points of strokes(part, this.wide)) {
        this.group.add(line(points, {color: inks.paper, pixels: hot ? 8 : 6, seenThrough: true, opacity: 0.8}));
        const drawn = line(points, {color, pixels: hot ? 4 : 2.5, seenThrough: true});
        drawn.renderOrder = 22;
        this.group.add(drawn);
      }
    }
    this.stage.invalidate();
  }

  warm(part: Part | null): void {
    if (part === this.#hot) return;
    this.#hot = part;
    this.stage.canvas.style.cursor = part ? 'grab' : '';
    this.repaint();
  }

  /** The part that is drawn under a point of the window. */
  under(x: number, y: number): Part | null {
    if (!this.group.visible) return null;
    const box = this.stage.canvas.getBoundingClientRect(), found: {part: Part | null; far: number} = {part: null, far: near_px};
    const middle = this.#onScreen([0, 0, 0])[0] ?? {x: -1000, y: -1000};
    for (const part of this.#parts)
      for (const points of strokes(part, this.wide)) {
        const seen = this.#onScreen(points);
        if (part === 'shift' && Math.hypot(x - box.left - middle.x, y - box.top - middle.y) < ring) return part;
        for (let i = 0; i + 1 < seen.length; ++i) {
          const far = distance(x - box.left, y - box.top, seen[i]!, seen[i + 1]!);
          if (far < found.far) Object.assign(found, {part, far});
        }
      }
    return found.part;
  }

  #onScreen(points: readonly number[]): {x: number; y: number}[] {
    this.group.updateWorldMatrix(true, false);
    const seen: {x: number; y: number}[] = [], at = new Vector3();
    for (let i = 0; i < points.length; i += 3) {
      const place = this.stage.onScreen(at.fromArray(points, i).applyMatrix4(this.group.matrixWorld));
      if (place) seen.push(place);
    }
    return seen;
  }

  #resize(): void {
    if (!this.group.visible) return;
    this.group.scale.setScalar(this.stage.mmPerPixel(this.group.getWorldPosition(new Vector3())));
    this.group.updateMatrixWorld();
  }
}

export function axisOf(part: Part): Vector3 | null {
  const name = part.at(-1) as 'x' | 'y' | 'z';
  return part === 'shift' || part === 'scale' ? null : axes[name];
}

/** How far along an axis through `at` a ray passes nearest. */
export function alongAxis(ray: Ray, at: Vector3, axis: Vector3): number {
  const between = at.clone().sub(ray.origin), cosine = ray.direction.dot(axis), away = 1 - cosine * cosine;
  return away < 1e-4 ? 0 : (cosine * between.dot(ray.direction) - between.dot(axis)) / away;
}

/** The angle about an axis through `at` where a ray meets the plane of the turn; null when that is seen edge on. */
export function angleAbout(ray: Ray, at: Vector3, axis: Vector3): number | null {
  const met = ray.intersectPlane(new Plane().setFromNormalAndCoplanarPoint(axis, at), new Vector3());
  if (!met || Math.abs(ray.direction.dot(axis)) < 0.02) return null;
  const first = new Vector3(axis.z, axis.x, axis.y), second = axis.clone().cross(first);
  met.sub(at);
  return Math.atan2(met.dot(second), met.dot(first));
}

/** Where a ray meets the plane through `at` that faces the camera, all in the coordinates of the ray. */
export function facingCamera(ray: Ray, at: Vector3, camera: Camera, parent: Object3D): Vector3 | null {
  const facing = camera.getWorldDirection(new Vector3()).transformDirection(parent.matrixWorld.clone().invert());
  return ray.intersectPlane(new Plane().setFromNormalAndCoplanarPoint(facing, at), new Vector3());
}

/** The lines that draw a part, and by which it is found, in pixels from the middle. */
function strokes(part: Part, wide: boolean): number[][] {
  const axis = axisOf(part);
  if (part === 'shift') return [circle(ring)];
  if (part === 'scale') {
    const at = (r: number) => [r * 0.707, 0, r * 0.707], [x, y, z] = at(knob) as [number, number, number], h = 5;
    return [[...at(arc + 8), ...at(knob - 7)], [x - h, y, z - h, x + h, y, z - h, x + h, y, z + h, x - h, y, z + h, x - h, y, z - h]];
  }
  const a = axis as Vector3, u = new Vector3(a.z, a.x, a.y), v = a.clone().cross(u);
  if (part.startsWith('turn'))
    return [Array.from({length: wide ? 65 : 17}, (_, n) => {
      const angle = wide ? (Math.PI * n) / 32 : 0.18 + ((Math.PI / 2 - 0.36) * n) / 16, r = wide ? circles : arc;
      return u.clone().multiplyScalar(r * Math.cos(angle)).addScaledVector(v, r * Math.sin(angle)).toArray();
    }).flat()];
  const point = (along: number, side: number) => a.clone().multiplyScalar(along).addScaledVector(u, side).toArray();
  const shaft = [...point(gap, 0), ...point(tip, 0)], head = [...point(tip - 9, 5), ...point(tip, 0), ...point(tip - 9, -5)];
  return [shaft, head, ...letter(part as 'x' | 'y' | 'z', point(tip + 13, 0))];
}

const letters = {x: [[-3, -4, 3, 4], [-3, 4, 3, -4]], y: [[-3, 4, 0, 0, 3, 4], [0, 0, 0, -4]], z: [[-3, 4, 3, 4, -3, -4, 3, -4]]};

/** The axis' letter, so that axes are told apart without colour; upright as seen from the front. */
function letter(name: 'x' | 'y' | 'z', at: number[]): number[][] {
  return letters[name].map((points) => points.flatMap((value, i) =>
    (i % 2 ? [] : [at[0]! + value, at[1]!, at[2]! + (points[i + 1] as number)])));
}

function circle(radius: number): number[] {
  return [[1, 0], [0, 1]].flatMap(([flat]) => Array.from({length: 25}, (_, n) => {
    const angle = (2 * Math.PI * n) / 24, c = radius * Math.cos(angle), s = radius * Math.sin(angle);
    return flat ? [c, s, 0] : [c, 0, s];
  }).flat());
}

function distance(x: number, y: number, a: {x: number; y: number}, b: {x: number; y: number}): number {
  const dx = b.x - a.x, dy = b.y - a.y, length = dx * dx + dy * dy || 1;
  const t = Math.max(0, Math.min(1, ((x - a.x) * dx + (y - a.y) * dy) / length));
  return Math.hypot(x - a.x - t * dx, y - a.y - t * dy);
}

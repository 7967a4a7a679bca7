import {type Camera, Group, type Object3D, Plane, type Ray, Vector3} from 'three';

import {readInks} from '../view/inks';
import {circleOf, cleared, facing, haloed} from '../view/lines';
import type {Stage} from '../view/stage';

export type Part = 'shift' | 'x' | 'y' | 'z' | 'turn-x' | 'turn-y' | 'turn-z' | 'scale';

const axes = {x: new Vector3(1, 0, 0), y: new Vector3(0, 1, 0), z: new Vector3(0, 0, 1)};
const near_px = 9;
const gap = 24, tip = 84, arc = 58, knob = 82, ring = 14, circles = 130; // pixels from the middle
const least = {arrow: 0.3, arc: 0.15}; // of its size: where less of it is seen, it is left out

interface Seen {
  readonly x: number;
  readonly y: number;
}

/** A line of a part in pixels: about the gizmo's middle, or in the plane of the screen about a point of it. */
interface Stroke {
  readonly points: readonly number[];
  readonly flatAt?: Vector3;
}

const origin = new Vector3();

/**
 * The thing to grasp a place by: arrows and the ring shift it, arcs turn it, the square scales it. Its size on the screen is
 * always the same, and its middle is open. What is seen end on would cover the middle and could not be dragged: it is left out.
 */
export class Gizmo {
  readonly group = new Group();
  readonly #drawn = new Map<Part, Group>();
  #square = Math.PI / 4; // where the square is, as an angle on the screen
  #theme: string | undefined; // that it is painted in
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
    this.#drawn.clear();
    this.#theme = document.documentElement.dataset.theme;
    const inks = readInks();
    for (const part of this.#parts) {
      const hot = part === this.#hot, color = hot ? inks.accent : inks.ink, pixels = (part === 'shift' ? 2 : 2.5) + (hot ? 1.5 : 0);
      const group = new Group();
      for (const {points, flatAt} of this.#strokes(part))
        haloed(points, {color, pixels, seenThrough: true}, inks.paper).forEach((drawn, order) => {
          drawn.renderOrder = 21 + order;
          group.add(flatAt ? facing(drawn) : drawn);
          if (flatAt) drawn.position.copy(flatAt);
        });
      this.group.add(group);
      this.#drawn.set(part, group);
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
    this.#fit();
    const box = this.stage.canvas.getBoundingClientRect(), at = {x: x - box.left, y: y - box.top};
    const found: {part: Part | null; far: number} = {part: null, far: near_px}, middle = this.#onScreen([0, 0, 0])[0];
    if (middle && this.#drawn.has('shift') && Math.hypot(at.x - middle.x, at.y - middle.y) < ring) return 'shift';
    for (const [part, group] of this.#drawn)
      for (const stroke of group.visible ? this.#strokes(part) : []) {
        const seen = this.#seen(stroke);
        for (let i = 0; i + 1 < seen.length; ++i) {
          const far = distance(at.x, at.y, seen[i]!, seen[i + 1]!);
          if (far < found.far) Object.assign(found, {part, far});
        }
      }
    return found.part;
  }

  /** The lines that draw a part, and by which it is found, in pixels from the middle. */
  #strokes(part: Part): Stroke[] {
    return part === 'shift' ? [{points: circleOf(ring), flatAt: origin}] : part === 'scale' ? square(this.#square) : strokes(part, this.wide);
  }

  #seen({points, flatAt}: Stroke): Seen[] {
    const about = flatAt && this.#onScreen(flatAt.toArray())[0];
    if (flatAt && !about) return [];
    return about ? Array.from({length: points.length / 3}, (_, n) => ({x: about.x + points[3 * n]!, y: about.y - points[3 * n + 1]!}))
                 : this.#onScreen(points);
  }

  #onScreen(points: readonly number[]): Seen[] {
    const seen: Seen[] = [], at = new Vector3();
    for (let i = 0; i < points.length; i += 3) {
      const place = this.stage.onScreen(at.fromArray(points, i).applyMatrix4(this.group.matrixWorld));
      if (place) seen.push(place);
    }
    return seen;
  }

  #resize(): void {
    if (!this.group.visible) return;
    if (this.#theme !== document.documentElement.dataset.theme) this.repaint();
    this.#fit();
    if (this.#drawn.has('scale')) this.#placeSquare();
    const from = this.stage.camera.getWorldPosition(new Vector3());
    const sight = this.group.worldToLocal(from).normalize(); // in its own axes
    for (const [part, drawn] of this.#drawn) {
      const axis = axisOf(part), along = axis ? Math.abs(axis.dot(sight)) : 0;
      drawn.visible = !axis || (part.startsWith('turn') ? along > least.arc : Math.sqrt(1 - along * along) > least.arrow);
    }
  }

  #fit(): void {
    this.group.scale.setScalar(this.stage.mmPerPixel(this.group.getWorldPosition(new Vector3())));
    this.group.updateWorldMatrix(true, true);
  }

  /** Moves the square out of the way of arrows and arcs; as seldom as can be, lest it wander while one looks around. */
  #placeSquare(): void {
    const middle = this.#onScreen([0, 0, 0])[0];
    if (!middle) return;
    const taken = Object.values(axes).flatMap((axis) => [axis.clone().multiplyScalar(tip), middleOfArc(axis)])
      .flatMap((point) => this.#onScreen(point.toArray())).filter((seen) => Math.hypot(seen.x - middle.x, seen.y - middle.y) > gap)
      .map((seen) => Math.atan2(middle.y - seen.y, seen.x - middle.x));
    const free = (angle: number) => Math.min(...taken.map((other) => Math.abs(Math.atan2(Math.sin(angle - other), Math.cos(angle - other)))));
    if (free(this.#square) > 0.45) return;
    const angles = Array.from({length: 24}, (_, n) => (Math.PI * n) / 12);
    const best = angles.reduce((most, angle) => (free(angle) > free(most) ? angle : most));
    if (free(best) < free(this.#square) + 0.1) return;
    this.#square = best;
    this.repaint();
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

/** The square on its stem. */
function square(angle: number): Stroke[] {
  const at = (r: number) => [r * Math.cos(angle), r * Math.sin(angle), 0], [x, y] = at(knob) as [number, number], h = 5;
  const corners = [x - h, y - h, 0, x + h, y - h, 0, x + h, y + h, 0, x - h, y + h, 0, x - h, y - h, 0];
  return [[...at(arc), ...at(knob - 7)], corners].map((points) => ({points, flatAt: origin}));
}

function middleOfArc(axis: Vector3): Vector3 {
  return new Vector3(1, 1, 1).sub(axis).setLength(arc);
}

/** An arrow, whose head is seen from all sides, or an arc. */
function strokes(part: Part, wide: boolean): Stroke[] {
  const a = axisOf(part) as Vector3, u = new Vector3(a.z, a.x, a.y), v = a.clone().cross(u);
  if (part.startsWith('turn'))
    return [{points: Array.from({length: wide ? 65 : 17}, (_, n) => {
      const angle = wide ? (Math.PI * n) / 32 : 0.18 + ((Math.PI / 2 - 0.36) * n) / 16, r = wide ? circles : arc;
      return u.clone().multiplyScalar(r * Math.cos(angle)).addScaledVector(v, r * Math.sin(angle)).toArray();
    }).flat()}];
  const point = (along: number, side = 0, to = u) => a.clone().multiplyScalar(along).addScaledVector(to, side);
  const through = (...points: Vector3[]) => ({points: points.flatMap((one) => one.toArray())});
  const head = (to: Vector3) => through(point(tip - 9, 5, to), point(tip), point(tip - 9, -5, to));
  return [through(point(gap), point(tip)), head(u), head(v), ...letter(part as 'x' | 'y' | 'z', point(tip + 13))];
}

const letters = {x: [[-3, -4, 3, 4], [-3, 4, 3, -4]], y: [[-3, 4, 0, 0, 3, 4], [0, 0, 0, -4]], z: [[-3, 4, 3, 4, -3, -4, 3, -4]]};

/** The axis' letter, so that axes are told apart without colour. */
function letter(name: 'x' | 'y' | 'z', flatAt: Vector3): Stroke[] {
  return letters[name].map((drawn) => ({
    points: drawn.flatMap((value, i) => (i % 2 ? [] : [value, drawn[i + 1]!, 0])), flatAt,
  }));
}

function distance(x: number, y: number, a: Seen, b: Seen): number {
  const dx = b.x - a.x, dy = b.y - a.y, length = dx * dx + dy * dy || 1;
  const t = Math.max(0, Math.min(1, ((x - a.x) * dx + (y - a.y) * dy) / length));
  return Math.hypot(x - a.x - t * dx, y - a.y - t * dy);
}

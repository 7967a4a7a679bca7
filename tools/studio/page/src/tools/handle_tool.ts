import {MathUtils, Matrix4, type Ray, Vector3} from 'three';

import {type Handle, type Job, type Vec3, bends, edited, mostBalls, withHandle, withHandles} from '../state/job';
import {degreesOf, rotationOf} from '../state/placement';
import {Gizmo, type Part, alongAxis, angleAbout, axisOf, facingCamera} from './gizmo';
import {handleAt} from './handle_at';
import {type Bench, type Tool, brushOf, tenth} from './tool';

const parts: readonly Part[] = ['shift', 'x', 'y', 'z', 'turn-x', 'turn-y', 'turn-z', 'scale'];

interface Grip {
  readonly part: Part;
  readonly index: number;
  readonly handle: Handle; // as it was
  readonly ray: Ray; // in placed coordinates
  readonly pixels: number; // from the middle of the gizmo
}

/** Adds handles and drags, turns or scales them; what the model makes of it is shown meanwhile. */
export class HandleTool implements Tool {
  readonly hint = 'Press the model to add a handle; drag its arrows, arcs or square. Shift: whole mm and 15°.';
  readonly #gizmo: Gizmo;
  #grip: Grip | null = null;
  #pressed: [number, number] | null = null;

  constructor(private readonly bench: Bench) {
    this.#gizmo = new Gizmo(bench.view.stage, bench.view.figure.pose);
    const follow = () => this.#follow();
    bench.documents.state.subscribe(follow);
    bench.ui.subscribe(follow);
  }

  begin(): void {
    const count = this.bench.documents.job.handles?.length ?? 0;
    if (count && this.bench.ui.value.handle === null) this.bench.ui.patch({handle: count - 1});
    this.#follow();
  }

  end(): void {
    this.#gizmo.show(null, parts);
    this.#gizmo.warm(null);
  }

  hover(x: number, y: number): void {
    this.#gizmo.warm(this.#gizmo.under(x, y));
  }

  down(x: number, y: number): boolean {
    const part = this.#gizmo.under(x, y), index = this.bench.ui.value.handle;
    const handle = index === null ? undefined : this.bench.documents.job.handles?.[index];
    if (part && index !== null && handle) {
      this.#grip = {part, index, handle, ray: this.#ray(x, y), pixels: this.#pixels(handle, x, y)};
      this.bench.conductor.previews.begin();
      return true;
    }
    this.#pressed = this.bench.view.picker.at(x, y) ? [x, y] : null;
    return this.#pressed !== null;
  }

  drag(x: number, y: number, event: PointerEvent): void {
    if (!this.#grip) return;
    this.bench.documents.hold(this.#pulled(this.#grip, x, y, event.shiftKey));
  }

  up(x: number, y: number, event: PointerEvent): void {
    const grip = this.#grip, from = this.#pressed;
    this.#grip = this.#pressed = null;
    if (grip) this.#rest(this.#pulled(grip, x, y, event.shiftKey));
    else if (from && Math.hypot(x - from[0], y - from[1]) < 5) this.#press(x, y);
  }

  cancel(): boolean {
    this.#pressed = null;
    if (!this.#grip) return false;
    this.#grip = null;
    this.bench.documents.drop();
    return true;
  }

  /** The full answer follows the first drag, unless it was told not to. */
  #rest(job: Job): void {
    const {documents, ui} = this.bench;
    documents.change(job, 'move a handle');
    if (ui.value.atOnce === null && bends(job)) ui.patch({atOnce: true});
  }

  /** Takes the handle that is there, else makes one. */
  #press(x: number, y: number): void {
    const hit = this.bench.view.picker.at(x, y), {job} = this.bench.documents.doc, handles = job.handles ?? [];
    if (!hit || handles.length >= mostBalls) return;
    const there = handleAt(handles, hit);
    if (there >= 0) return this.bench.ui.patch({handle: there});
    const handle: Handle = {at_mm: hit.placed.map(tenth) as unknown as Vec3, radius_mm: brushOf(this.bench)};
    this.bench.documents.change(withHandles(job, [...handles, handle]), 'add a handle');
    this.bench.ui.patch({handle: handles.length});
  }

  #pulled(grip: Grip, x: number, y: number, snaps: boolean): Job {
    return withHandle(this.bench.documents.doc.job, grip.index, this.#moved(grip, x, y, snaps));
  }

  #moved({part, handle, ray, pixels}: Grip, x: number, y: number, snaps: boolean): Handle {
    const at = new Vector3(...(handle.to_mm ?? handle.at_mm)), now = this.#ray(x, y), axis = axisOf(part);
    const grid = (value: number) => (snaps ? Math.round(value) : tenth(value));
    if (part === 'scale') {
      const ratio = (handle.scale ?? 1) * (this.#pixels(handle, x, y) / Math.max(8, pixels));
      return edited(handle, {scale: MathUtils.clamp(snaps ? Math.round(10 * ratio) / 10 : tenth(ratio), 0.2, 5)});
    }
    if (axis && part.startsWith('turn')) {
      const from = angleAbout(ray, at, axis), to = angleAbout(now, at, axis);
      if (from === null || to === null) return handle;
      const raw = MathUtils.radToDeg(to - from), angle = MathUtils.degToRad(snaps ? 15 * Math.round(raw / 15) : raw);
      const turn = new Matrix4().makeRotationAxis(axis, angle).multiply(rotationOf(handle.turn_deg));
      return edited(handle, {turn_deg: degreesOf(turn).map(tenth) as unknown as Vec3});
    }
    const shift = axis ? axis.clone().multiplyScalar(alongAxis(now, at, axis) - alongAxis(ray, at, axis))
                       : this.#sideways(ray, now, at);
    return edited(handle, {to_mm: at.add(shift).toArray().map(grid) as unknown as Vec3});
  }

  #sideways(from: Ray, to: Ray, at: Vector3): Vector3 {
    const {stage, figure} = this.bench.view;
    const a = facingCamera(from, at, stage.camera, figure.pose), b = facingCamera(to, at, stage.camera, figure.pose);
    return a && b ? b.sub(a) : new Vector3();
  }

  #ray(x: number, y: number): Ray {
    const {picker, figure} = this.bench.view;
    return picker.ray(x, y).ray.clone().applyMatrix4(figure.pose.matrixWorld.clone().invert());
  }

  /** Pixels from the middle of the gizmo to a point of the window. */
  #pixels(handle: Handle, x: number, y: number): number {
    const {stage, figure} = this.bench.view, box = stage.canvas.getBoundingClientRect();
    const seen = stage.onScreen(new Vector3(...(handle.to_mm ?? handle.at_mm)).applyMatrix4(figure.pose.matrixWorld));
    return seen ? Math.hypot(x - box.left - seen.x, y - box.top - seen.y) : 0;
  }

  #follow(): void {
    const {documents, ui} = this.bench, index = ui.value.handle;
    const handle = index === null ? undefined : documents.job.handles?.[index];
    if (index !== null && !handle) return ui.patch({handle: null});
    const shown = ui.value.tool === 'handle' && handle;
    this.#gizmo.show(shown ? new Vector3(...(handle.to_mm ?? handle.at_mm)) : null, parts);
  }
}

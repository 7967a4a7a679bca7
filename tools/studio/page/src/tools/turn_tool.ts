import {MathUtils, Quaternion, type Ray, Vector3} from 'three';

import {type Direction, posesOf, withHang, withPlace, withStand} from '../state/job';
import {turnUpright, turnedFurther} from '../state/placement';
import {Gizmo, type Part, angleAbout, axisOf} from './gizmo';
import type {Bench, Tool} from './tool';

const parts: readonly Part[] = ['turn-x', 'turn-y', 'turn-z'], ofUp: readonly Part[] = ['turn-x', 'turn-y'];

/** Turns the model on its plate by three arcs. */
export class TurnTool implements Tool {
  readonly hint = 'Drag an arc to turn the model. Shift: by 15°.';
  readonly #gizmo: Gizmo;
  #shown = parts;
  #grip: {part: Part; ray: Ray; middle: Vector3} | null = null;

  constructor(private readonly bench: Bench) {
    this.#gizmo = new Gizmo(bench.view.stage, bench.view.stage.scene, true);
    bench.view.stage.beforeDraw.add(() => this.#follow());
  }

  begin(): void {
    const box = this.bench.view.figure.box();
    this.#shown = this.#parts;
    this.#gizmo.show(box.isEmpty() ? null : box.getCenter(new Vector3()), this.#shown);
  }

  /** A way up of a pose's own is the same however it is turned about the vertical. */
  get #parts(): readonly Part[] {
    return ownUp(this.bench) === undefined ? parts : ofUp;
  }

  /** Keeps to the middle of a figure that was placed anew, and to the pose. */
  #follow(): void {
    const box = this.bench.view.figure.box();
    if (this.bench.ui.value.tool !== 'turn' || this.#grip || box.isEmpty()) return;
    const isThere = box.getCenter(new Vector3()).distanceTo(this.#gizmo.group.position) <= 1e-6;
    if (!isThere || this.#shown !== this.#parts) this.begin();
  }

  end(): void {
    this.#gizmo.show(null, parts);
    this.#gizmo.warm(null);
  }

  hover(x: number, y: number): void {
    this.#gizmo.warm(this.#gizmo.under(x, y));
  }

  down(x: number, y: number): boolean {
    const part = this.#gizmo.under(x, y);
    if (!part) return false;
    this.#grip = {part, ray: this.bench.view.picker.ray(x, y).ray.clone(), middle: this.#gizmo.group.position.clone()};
    return true;
  }

  drag(x: number, y: number, event: PointerEvent): void {
    if (this.#grip) this.#preview(this.#turn(x, y, event.shiftKey), this.#grip.middle);
  }

  up(x: number, y: number, event: PointerEvent): void {
    const turn = this.#turn(x, y, event.shiftKey);
    this.#rest();
    if (Math.abs(turn.w) < 1 - 1e-9) this.#change(turn);
  }

  cancel(): boolean {
    const held = this.#grip !== null;
    this.#rest();
    return held;
  }

  #rest(): void {
    this.#grip = null;
    this.#preview(new Quaternion(), new Vector3());
  }

  #preview(turn: Quaternion, middle: Vector3): void {
    const {falling, stage} = this.bench.view;
    falling.quaternion.copy(turn);
    falling.position.copy(middle).sub(middle.clone().applyQuaternion(turn));
    stage.invalidate();
  }

  #turn(x: number, y: number, snaps: boolean): Quaternion {
    const axis = this.#grip && axisOf(this.#grip.part);
    if (!this.#grip || !axis) return new Quaternion();
    const from = angleAbout(this.#grip.ray, this.#grip.middle, axis);
    const to = angleAbout(this.bench.view.picker.ray(x, y).ray, this.#grip.middle, axis);
    if (from === null || to === null) return new Quaternion();
    const degrees = MathUtils.radToDeg(to - from);
    return new Quaternion().setFromAxisAngle(axis, MathUtils.degToRad(snaps ? 15 * Math.round(degrees / 15) : degrees));
  }

  /** A pose with a way up of its own gets another one; else the placement changes. */
  #change(turn: Quaternion): void {
    const {documents, ui} = this.bench, {job} = documents.doc, index = ui.value.pose, pose = posesOf(job)[index];
    if (ownUp(this.bench) === undefined)
      return documents.change(withPlace(job, {rotate_deg: turnedFurther(job, turn)}), 'turn');
    const upright = turnUpright(new Vector3(0, 0, 1).toArray());
    const shown = turn.clone().multiply(this.bench.view.figure.pose.quaternion).multiply(upright);
    const up = new Vector3(0, 0, 1).applyQuaternion(shown.invert()).toArray();
    documents.change(pose?.stand ? withStand(job, index, {up}) : withHang(job, index, {up}), 'turn');
  }
}

function ownUp({documents, ui}: Bench): Direction | undefined {
  const pose = posesOf(documents.doc.job)[ui.value.pose];
  return pose?.stand?.up ?? pose?.hang?.up;
}

import {Quaternion, Vector3} from 'three';

import {posesOf, withHang, withPlace, withStand} from '../state/job';
import {turnOntoPlate, turnedFurther} from '../state/placement';
import type {Hit} from '../view/pick';
import {line} from '../view/lines';
import {readInks} from '../view/inks';
import type {Bench, Tool} from './tool';
import {heightOf} from './tool';

/** Lays the face that is pressed onto the plate. A pose with a way up of its own gets another one; else the model is turned. */
export class LayOnFace implements Tool {
  readonly hint = 'Press a face: it is laid on the plate.';
  #mark: ReturnType<typeof line> | null = null;
  #pressed: [number, number] | null = null;

  constructor(private readonly bench: Bench) {}

  hover(x: number, y: number): void {
    this.#show(this.bench.view.picker.at(x, y));
  }

  down(x: number, y: number): boolean {
    this.#pressed = this.bench.view.picker.at(x, y) ? [x, y] : null;
    return this.#pressed !== null;
  }

  up(x: number, y: number): void {
    const from = this.#pressed;
    this.#pressed = null;
    const hit = from && Math.hypot(x - from[0], y - from[1]) < 5 ? this.bench.view.picker.at(x, y) : null;
    if (hit) this.#lay(hit.normal);
    this.#show(null);
  }

  end(): void {
    this.#show(null);
  }

  #lay(normal: Vector3): void {
    const {documents, ui} = this.bench, {job} = documents.doc, pose = posesOf(job)[ui.value.pose];
    const up = normal.clone().negate().normalize(), own = pose?.stand?.up ?? pose?.hang?.up;
    if (own !== undefined) {
      const fields = {up: [up.x, up.y, up.z] as const};
      documents.change(pose?.stand ? withStand(job, ui.value.pose, fields) : withHang(job, ui.value.pose, fields), 'lay on a face');
    } else {
      documents.change(withPlace(job, {rotate_deg: turnedFurther(job, turnOntoPlate(normal))}), 'lay on a face');
    }
    ui.patch({tool: 'look'});
  }

  #show(hit: Hit | null): void {
    const {view} = this.bench;
    this.#mark?.removeFromParent();
    this.#mark?.geometry.dispose();
    this.#mark = null;
    if (hit) {
      const size = 0.07 * heightOf(this.bench.results), points: number[] = [], at = new Vector3();
      const turn = new Quaternion().setFromUnitVectors(new Vector3(0, 0, 1), hit.normal);
      for (let n = 0; n <= 40; ++n) {
        const angle = (2 * Math.PI * n) / 40;
        at.set(size * Math.cos(angle), size * Math.sin(angle), 0).applyQuaternion(turn);
        points.push(hit.placed[0] + at.x, hit.placed[1] + at.y, hit.placed[2] + at.z);
      }
      at.copy(hit.normal).multiplyScalar(1.6 * size);
      points.push(...hit.placed, hit.placed[0] + at.x, hit.placed[1] + at.y, hit.placed[2] + at.z);
      this.#mark = line(points, {color: readInks().accent, pixels: 2.5, seenThrough: true});
      view.figure.pose.add(this.#mark);
    }
    view.stage.invalidate();
  }
}

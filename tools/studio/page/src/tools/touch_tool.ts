import {posesOf, type Vec3, withHang, withStand} from '../state/job';
import type {Hit} from '../view/pick';
import {type Bench, type Tool, brushOf, tenth} from './tool';

/** Picks where the surface may touch the plate; in a pose that hangs, where it hangs from. */
export class TouchTool implements Tool {
  readonly hint = 'Press what may touch the plate, or in a hanging pose where it hangs from; press again to take it away.';
  #pressed: [number, number] | null = null;

  constructor(private readonly bench: Bench) {}

  down(x: number, y: number): boolean {
    this.#pressed = this.bench.view.picker.at(x, y) ? [x, y] : null;
    return this.#pressed !== null;
  }

  up(x: number, y: number): void {
    const from = this.#pressed;
    this.#pressed = null;
    const hit = from && Math.hypot(x - from[0], y - from[1]) < 5 ? this.bench.view.picker.at(x, y) : null;
    if (hit) this.#toggle(this.#under(hit).map(tenth) as unknown as Vec3);
  }

  /** In a pose that stands, the point of the plate under what was pressed: a press on a foot means its sole. */
  #under(hit: Hit): Vec3 {
    const {documents, ui, view} = this.bench;
    if (posesOf(documents.doc.job)[ui.value.pose]?.hang) return hit.placed;
    return hit.at.clone().setZ(0).applyMatrix4(view.figure.pose.matrixWorld.clone().invert()).toArray();
  }

  #toggle(at: Vec3): void {
    const {documents, ui} = this.bench, {job} = documents.doc, index = ui.value.pose, pose = posesOf(job)[index];
    const isNear = (other: Vec3, radius: number) =>
      Math.hypot(at[0] - other[0], at[1] - other[1], at[2] - other[2]) <= radius;
    const radius_mm = brushOf(this.bench);
    if (pose?.hang) {
      const rest = pose.hang.from_mm.filter((from) => !isNear(from, radius_mm));
      const from_mm = rest.length < pose.hang.from_mm.length && rest.length ? rest : [...rest, at].slice(-2);
      return documents.change(withHang(job, index, {from_mm}), 'hang from');
    }
    const contacts = pose?.stand?.contacts ?? [];
    const rest = contacts.filter((contact) => !isNear(contact.at_mm, contact.radius_mm ?? radius_mm));
    const changed = rest.length < contacts.length ? rest : [...contacts, {at_mm: at, radius_mm}];
    documents.change(withStand(job.poses ? job : {...job, poses: posesOf(job)}, index, {contacts: changed}), 'what touches');
  }
}

import {Group, Vector3} from 'three';

import {type Handle, type Job, type Vec3, moves, posesOf, poseUp} from '../state/job';
import type {Inks} from './inks';
import {circleOf, cleared, facing, haloed} from './lines';

/** What the job says about places of the model: contacts, handles and where they go, threads to hang from. */
export class PoseMarks {
  readonly group = new Group(); // in placed coordinates
  #shown = '';

  show(job: Job, index: number, inks: Inks, height: number, selected: number | null): void {
    const pose = posesOf(job)[index];
    const shown = JSON.stringify([pose, job.handles, height, selected, inks.ink.getHex()]);
    if (shown === this.#shown) return;
    this.#shown = shown;
    cleared(this.group);
    const up = new Vector3(...(pose ? poseUp(pose) : [0, 0, 1])).normalize();
    for (const contact of pose?.stand?.contacts ?? [])
      this.#circle(contact.at_mm, Math.max(0.005 * height, contact.radius_mm ?? 0.05 * height), up, inks, 2);
    for (const from of pose?.hang?.from_mm ?? []) this.#thread(from, up, height, inks);
    (job.handles ?? []).forEach((handle, at) => this.#handle(handle, inks, height, at === selected));
  }

  /** A handle's ball as its outline, which leaves free to be seen what it holds. */
  #handle(handle: Handle, inks: Inks, height: number, isSelected: boolean): void {
    const radius = Math.max(0.015 * height, (handle.radius_mm ?? 0) * (handle.scale ?? 1)), to = handle.to_mm ?? handle.at_mm;
    for (const drawn of haloed(circleOf(radius), {color: inks.accent, pixels: isSelected ? 2 : 1.2, seenThrough: true}, inks.paper)) {
      drawn.position.set(...to);
      this.group.add(facing(drawn));
    }
    if (!moves(handle)) return;
    const way = {color: inks.accent, pixels: 2, dash_mm: height / 60, seenThrough: true};
    this.group.add(...haloed([...handle.at_mm, ...to], way, inks.paper));
    this.#circle(handle.at_mm, 0.012 * height, new Vector3(0, 0, 1), inks, 1.5);
  }

  #thread(from: Vec3, up: Vector3, height: number, inks: Inks): void {
    const end = new Vector3(...from).addScaledVector(up, 1.2 * height);
    this.group.add(...haloed([...from, end.x, end.y, end.z], {color: inks.ink, pixels: 2, seenThrough: true}, inks.paper));
    this.#circle(from, 0.015 * height, up, inks, 2.5);
  }

  #circle(at: Vec3, radius: number, normal: Vector3, inks: Inks, pixels: number): void {
    for (const drawn of haloed(circleOf(radius), {color: inks.accent, pixels, seenThrough: true}, inks.paper)) {
      drawn.position.set(...at);
      drawn.quaternion.setFromUnitVectors(new Vector3(0, 0, 1), normal);
      this.group.add(drawn);
    }
  }
}

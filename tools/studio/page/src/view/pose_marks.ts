import {Group, Quaternion, Vector3} from 'three';

import {type Handle, type Job, type Vec3, moves, posesOf, poseUp} from '../state/job';
import type {Inks} from './inks';
import {cleared, line} from './lines';

const corners = 48;

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

  #handle(handle: Handle, inks: Inks, height: number, isSelected: boolean): void {
    const radius = Math.max(0.008 * height, handle.radius_mm ?? 0), to = handle.to_mm ?? handle.at_mm;
    for (const normal of [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)])
      this.#circle(to, radius * (handle.scale ?? 1), normal, inks, isSelected ? 2 : 1.2);
    if (!moves(handle)) return;
    this.group.add(line([...handle.at_mm, ...to], {color: inks.accent, pixels: 2, dash_mm: height / 60, seenThrough: true}));
    this.#circle(handle.at_mm, 0.012 * height, new Vector3(0, 0, 1), inks, 1.5);
  }

  #thread(from: Vec3, up: Vector3, height: number, inks: Inks): void {
    const end = new Vector3(...from).addScaledVector(up, 1.2 * height);
    this.group.add(line([...from, end.x, end.y, end.z], {color: inks.ink, pixels: 2, seenThrough: true}));
    this.#circle(from, 0.015 * height, up, inks, 2.5);
  }

  #circle(at: Vec3, radius: number, normal: Vector3, inks: Inks, pixels: number): void {
    const turn = new Quaternion().setFromUnitVectors(new Vector3(0, 0, 1), normal), point = new Vector3();
    const points: number[] = [];
    for (let n = 0; n <= corners; ++n) {
      const angle = (2 * Math.PI * n) / corners;
      point.set(radius * Math.cos(angle), radius * Math.sin(angle), 0).applyQuaternion(turn);
      points.push(at[0] + point.x, at[1] + point.y, at[2] + point.z);
    }
    this.group.add(line(points, {color: inks.accent, pixels, seenThrough: true}));
  }
}

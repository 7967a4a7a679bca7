import {Group, Quaternion, Vector3} from 'three';

import type {Stage} from './stage';
import type {Surface} from './surface';

const reduced = () => matchMedia('(prefers-reduced-motion: reduce)').matches;

/** Where and how far it falls: about an edge on the plate, until something else touches the plate. */
export interface Fall {
  readonly edge: Vector3; // a point of the edge
  readonly axis: Vector3; // along it, such that a positive turn falls outward
  readonly landing: number; // rad
}

/** The fall of a posed surface over an edge towards `heading`, all in mm of the plate. */
export function fallOver(surface: Surface, pose: Group, edge: Vector3, heading: Vector3): Fall {
  const axis = new Vector3(0, 0, 1).cross(heading).normalize(), at = new Vector3();
  let landing = Math.PI / 2;
  pose.updateMatrixWorld();
  for (let i = 0; i < surface.positions.length; i += 3) {
    at.fromArray(surface.positions, i).applyMatrix4(pose.matrixWorld).sub(edge);
    const out = at.dot(heading), high = at.z;
    if (out > 0.5 && high > 0) landing = Math.min(landing, Math.atan2(high, out));
  }
  return {edge, axis, landing};
}

const rise_ms = 1400, drop_ms = 1300, rest_ms = 900;

/**
 * The turn `since` ms after the beginning, rad; null at the end. It is tilted by `first`, which the plate would have to be before
 * it falls, then drops. Where motion is unwelcome it jumps: one picture of it tilted, one of it fallen.
 */
export function fallenBy(landing: number, first: number, since: number, isStill: boolean): number | null {
  const rise = first > 0 ? rise_ms : 0, drop = isStill ? 0 : drop_ms;
  if (since > rise + drop + rest_ms) return null;
  const tilt = rise === 0 ? 0 : isStill ? first : first * smooth(Math.min(1, since / rise));
  const down = isStill ? Number(since >= rise) : Math.min(1, Math.max(0, since - rise) / drop);
  return tilt + Math.max(0, landing - tilt) * down ** 3;
}

/** Turns a group over an edge, slowly at first, and puts it back. Ends early when asked to. */
export class FallPlayer {
  #frame = 0;

  constructor(private readonly stage: Stage, private readonly group: Group, private readonly ended: () => void) {}

  get playing(): boolean {
    return this.#frame !== 0;
  }

  /** `first`: radians that the plate would have to be tilted before it falls. */
  play(fall: Fall, first: number): void {
    this.stop();
    const begin = performance.now(), isStill = reduced();
    const step = () => {
      const angle = fallenBy(fall.landing, first, performance.now() - begin, isStill);
      if (angle === null) return this.stop();
      this.#turn(fall, angle);
      this.#frame = requestAnimationFrame(step);
    };
    this.#frame = requestAnimationFrame(step);
  }

  stop(): void {
    if (!this.#frame) return;
    cancelAnimationFrame(this.#frame);
    this.#frame = 0;
    this.group.position.set(0, 0, 0);
    this.group.quaternion.identity();
    this.stage.invalidate();
    this.ended();
  }

  #turn(fall: Fall, angle: number): void {
    this.group.quaternion.copy(new Quaternion().setFromAxisAngle(fall.axis, angle));
    this.group.position.copy(fall.edge).sub(fall.edge.clone().applyQuaternion(this.group.quaternion));
    this.stage.invalidate();
  }
}

const smooth = (t: number) => t * t * (3 - 2 * t);

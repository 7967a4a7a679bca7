import type {Ball, Job, Vec3} from '../state/job';
import type {Surface} from './surface';

export const locked = 1, touching = 2, grasped = 3;

interface Painted {
  readonly at: Vec3;
  readonly radius: number;
  readonly as: number;
}

/** Marks the vertices that lie in the balls of a job: what is locked, what may touch in this pose, what handles hold. */
export class Painter {
  #done: readonly unknown[] = [];

  /** Paints what is not painted yet. */
  paint(surface: Surface, job: Job, pose: number, height: number): void {
    const held = JSON.stringify(job.handles?.map((handle) => [handle.at_mm, handle.radius_mm]));
    const wanted = [surface, job.lock, job.poses?.[pose]?.stand?.contacts, held, height];
    if (wanted.every((one, i) => one === this.#done[i])) return;
    this.#done = wanted;
    paintRegions(surface, job, pose, height);
  }

  /** Forgets what was painted, as when a stroke was dropped. */
  forget(): void {
    this.#done = [];
  }
}

function paintRegions(surface: Surface, job: Job, pose: number, height: number): void {
  const least = 0.01 * height; // so that a point can be seen
  const ball = (b: {at_mm: Vec3; radius_mm?: number}, as: number, standard = least): Painted =>
    ({at: b.at_mm, radius: Math.max(least, b.radius_mm ?? standard), as});
  const balls = [
    ...(job.lock ?? []).map((b: Ball) => ball(b, locked)),
    ...(job.poses?.[pose]?.stand?.contacts ?? []).map((b) => ball(b, touching, 0.05 * height)),
    ...(job.handles ?? []).map((b) => ball(b, grasped)),
  ];
  surface.paint.fill(0);
  for (const b of balls) paintBall(surface, b.at, b.radius, b.as);
  surface.painted();
}

export function paintBall(surface: Surface, at: Vec3, radius: number, as: number): void {
  const p = surface.rest, [x, y, z] = at, most = radius * radius;
  for (let v = 0, i = 0; i < p.length; ++v, i += 3) {
    const dx = p[i]! - x;
    if (dx > radius || dx < -radius) continue;
    const dy = p[i + 1]! - y, dz = p[i + 2]! - z;
    if (dx * dx + dy * dy + dz * dz <= most) surface.paint[v] = as;
  }
}

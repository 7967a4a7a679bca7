/** A job as lib/aplomb/job/job.schema.json has it, less its version and the keys that name files. Lengths in mm, angles in degrees. */

export type Vec3 = readonly [number, number, number];
export type Axis = 'x' | 'y' | 'z' | '-x' | '-y' | '-z';
export type Direction = Axis | Vec3;

export interface Ball {
  readonly at_mm: Vec3;
  readonly radius_mm: number;
}

export interface Contact {
  readonly at_mm: Vec3;
  readonly radius_mm?: number;
}

export interface Handle {
  readonly at_mm: Vec3;
  readonly radius_mm?: number;
  readonly to_mm?: Vec3;
  readonly turn_deg?: Vec3;
  readonly scale?: number;
}

export interface Stand {
  readonly up?: Direction;
  readonly tip_deg?: number;
  readonly contacts?: readonly Contact[];
  readonly [other: string]: unknown;
}

export interface Hang {
  readonly up?: Direction;
  readonly from_mm: readonly Vec3[];
  readonly tilt_deg?: number;
  readonly [other: string]: unknown;
}

export interface Pose {
  readonly name?: string;
  readonly stand?: Stand;
  readonly hang?: Hang;
}

export interface Place {
  readonly object?: number;
  readonly up?: Axis;
  readonly rotate_deg?: Vec3;
  readonly unit_mm?: number;
  readonly scale?: number;
  readonly height_mm?: number;
}

export interface Job {
  readonly place?: Place;
  readonly poses?: readonly Pose[];
  readonly aim?: 'least' | 'light' | 'stable';
  readonly deform?: 'never' | 'auto' | 'only';
  readonly handles?: readonly Handle[];
  readonly lock?: readonly Ball[];
  readonly keep?: readonly Ball[];
  readonly process?: string;
  readonly material?: string;
  readonly wall_mm?: number;
  readonly robust?: boolean;
  readonly ballast?: 'never' | 'auto' | 'only';
  readonly best_effort?: boolean;
  readonly [other: string]: unknown;
}

export const emptyJob: Job = {};
export const defaultTipDeg = 10;
export const defaultTiltDeg = 2;
export const mostBalls = 1000;

const upVectors: Record<Axis, Vec3> = {
  x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1], '-x': [-1, 0, 0], '-y': [0, -1, 0], '-z': [0, 0, -1],
};

export function vectorOf(direction: Direction | undefined): Vec3 {
  if (direction === undefined) return [0, 0, 1];
  return typeof direction === 'string' ? upVectors[direction] : direction;
}

/** An object with some fields changed; those set to undefined, and lists left empty, are gone. */
export function edited<T extends object>(object: T, fields: Partial<T>): T {
  const changed = {...object, ...fields} as Record<string, unknown>;
  for (const [key, value] of Object.entries(changed))
    if (value === undefined || (Array.isArray(value) && value.length === 0)) delete changed[key];
  return changed as T;
}

/** The poses; where the job has none it is to stand as it is placed. */
export function posesOf(job: Job): readonly Pose[] {
  return job.poses ?? [{stand: {}}];
}

export function poseName(pose: Pose, index: number): string {
  return pose.name ?? `pose ${index + 1}`;
}

export function poseUp(pose: Pose): Vec3 {
  return vectorOf(pose.stand?.up ?? pose.hang?.up);
}

export function withPose(job: Job, index: number, pose: Pose): Job {
  return {...job, poses: posesOf(job).map((other, at) => (at === index ? pose : other))};
}

export function withStand(job: Job, index: number, fields: Partial<Stand>): Job {
  const pose = posesOf(job)[index];
  return pose?.stand ? withPose(job, index, {...pose, stand: edited(pose.stand, fields)}) : job;
}

export function withHang(job: Job, index: number, fields: Partial<Hang>): Job {
  const pose = posesOf(job)[index];
  return pose?.hang ? withPose(job, index, {...pose, hang: edited(pose.hang, fields)}) : job;
}

export function withPlace(job: Job, fields: Partial<Place>): Job {
  const place = edited(job.place ?? {}, fields);
  return edited(job, {place: Object.keys(place).length ? place : undefined});
}

/** With handles the outside moves, which a job has to allow. */
export function withHandles(job: Job, handles: readonly Handle[]): Job {
  const mayMove = job.deform === 'auto' || job.deform === 'only';
  return edited(job, {handles, deform: handles.length && !mayMove ? 'auto' : job.deform});
}

export function withHandle(job: Job, index: number, handle: Handle): Job {
  return withHandles(job, (job.handles ?? []).map((other, at) => (at === index ? handle : other)));
}

/** Whether a handle asks for any change. */
export function moves(handle: Handle): boolean {
  const to = handle.to_mm, turn = handle.turn_deg;
  return (to !== undefined && to.some((value, axis) => value !== handle.at_mm[axis])) ||
    (turn !== undefined && turn.some((value) => value !== 0)) || (handle.scale ?? 1) !== 1;
}

export function bends(job: Job): boolean {
  return (job.handles ?? []).some(moves);
}

/** What changes where the model's points are: the model's placement as text, to be compared. */
export function placeKey(job: Job): string {
  const place = job.place ?? {};
  return JSON.stringify([place.object, place.up, place.rotate_deg, place.unit_mm, place.scale, place.height_mm]);
}

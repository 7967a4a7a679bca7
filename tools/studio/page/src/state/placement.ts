import {Euler, MathUtils, Matrix3, Matrix4, Quaternion, Vector3} from 'three';

import {type Axis, type Direction, type Job, type Pose, type Vec3, edited, vectorOf} from './job';

/** The server's 12 numbers, rows of a 3 x 4 matrix. */
export function matrixOf(rows: readonly number[]): Matrix4 {
  const [a, b, c, d, e, f, g, h, i, j, k, l] = rows as [
    number, number, number, number, number, number, number, number, number, number, number, number];
  return new Matrix4(a, b, c, d, e, f, g, h, i, j, k, l, 0, 0, 0, 1);
}

/** The quarter turn of `place.up`, as lib/aplomb/mesh/placement.cpp has it. */
export function upMatrix(up: Axis | undefined): Matrix4 {
  const rows: Record<Axis, number[]> = {
    x: [0, 0, -1, 0, 1, 0, 1, 0, 0], '-x': [0, 0, 1, 0, 1, 0, -1, 0, 0], y: [1, 0, 0, 0, 0, -1, 0, 1, 0],
    '-y': [1, 0, 0, 0, 0, 1, 0, -1, 0], z: [1, 0, 0, 0, 1, 0, 0, 0, 1], '-z': [1, 0, 0, 0, -1, 0, 0, 0, -1],
  };
  const [a, b, c, d, e, f, g, h, i] = rows[up ?? 'z'] as [
    number, number, number, number, number, number, number, number, number];
  return new Matrix4().setFromMatrix3(new Matrix3(a, b, c, d, e, f, g, h, i));
}

/** Turns about the plate's x, then y, then z: R = Rz Ry Rx. */
export function rotationOf(degrees: Vec3 | undefined): Matrix4 {
  const [x, y, z] = (degrees ?? [0, 0, 0]).map(MathUtils.degToRad) as [number, number, number];
  return new Matrix4().makeRotationFromEuler(new Euler(x, y, z, 'ZYX'));
}

/** The turns of a rotation, rounded to a millionth of a degree. */
export function degreesOf(rotation: Matrix4): Vec3 {
  const euler = new Euler().setFromRotationMatrix(rotation, 'ZYX');
  const rounded = (radians: number) => Math.round(MathUtils.radToDeg(radians) * 1e6) / 1e6 + 0;
  return [rounded(euler.x), rounded(euler.y), rounded(euler.z)];
}

/** `place.rotate_deg` such that what is placed by `job` is turned further; undefined for none. */
export function turnedFurther(job: Job, turn: Quaternion): Vec3 | undefined {
  const total = new Matrix4().makeRotationFromQuaternion(turn).multiply(rotationOf(job.place?.rotate_deg));
  const degrees = degreesOf(total);
  return degrees.some((value) => value !== 0) ? degrees : undefined;
}

/** The turn that brings an outward normal down onto the plate. */
export function turnOntoPlate(normal: Vector3): Quaternion {
  return new Quaternion().setFromUnitVectors(normal.clone().normalize(), new Vector3(0, 0, -1));
}

/** The turn that shows a pose: its up to the plate's z. */
export function turnUpright(up: Vec3): Quaternion {
  return new Quaternion().setFromUnitVectors(new Vector3(...up).normalize(), new Vector3(0, 0, 1));
}

const rounded = (value: number) => Math.round(value * 1e4) / 1e4;
const tuple = (v: Vector3): Vec3 => [rounded(v.x), rounded(v.y), rounded(v.z)];

function carriedDirection(up: Direction | undefined, turn: Quaternion): Direction | undefined {
  if (up === undefined) return undefined;
  const carried = new Vector3(...vectorOf(up)).applyQuaternion(turn);
  return [carried.x, carried.y, carried.z];
}

/**
 * The job with all of its points carried along when the placement changes by `change`.
 *
 * A pose without a direction of its own stays upright on the plate: that is what the placement was changed for.
 */
export function carried(job: Job, change: Matrix4): Job {
  const turn = new Quaternion(), scale = new Vector3();
  change.decompose(new Vector3(), turn, scale);
  const factor = Math.cbrt(Math.abs(change.determinant()));
  const point = (at: Vec3): Vec3 => tuple(new Vector3(...at).applyMatrix4(change));
  const ball = <T extends {at_mm: Vec3; radius_mm?: number}>(b: T): T =>
    ({...b, at_mm: point(b.at_mm), ...(b.radius_mm === undefined ? {} : {radius_mm: rounded(b.radius_mm * factor)})});
  const pose = (p: Pose): Pose => edited(p, {
    stand: p.stand && edited(p.stand, {up: carriedDirection(p.stand.up, turn), contacts: p.stand.contacts?.map(ball)}),
    hang: p.hang && edited(p.hang, {up: carriedDirection(p.hang.up, turn), from_mm: p.hang.from_mm.map(point)}),
  });
  return edited(job, {
    poses: job.poses?.map(pose),
    keep: job.keep?.map(ball),
    lock: job.lock?.map(ball),
    handles: job.handles?.map((h) => edited(ball(h), {
      to_mm: h.to_mm && point(h.to_mm), turn_deg: h.turn_deg && carriedTurn(h.turn_deg, turn),
    })),
    ...(Array.isArray(job.stiffness) ? {stiffness: (job.stiffness as {at_mm: Vec3; radius_mm: number}[]).map(ball)} : {}),
  });
}

/** A handle's turn seen from the turned plate: Q R Q^-1. */
function carriedTurn(turn_deg: Vec3, turn: Quaternion): Vec3 {
  const q = new Matrix4().makeRotationFromQuaternion(turn);
  return degreesOf(q.clone().multiply(rotationOf(turn_deg)).multiply(q.clone().transpose()));
}

import type {Vec3} from '../state/job';

/** A point of the plate, mm. */
export interface OnPlate {
  readonly x: number;
  readonly y: number;
}

/** How a body stands on the plate: its support polygon, counterclockwise, and its centre of mass. */
export interface Balance {
  readonly polygon: readonly OnPlate[];
  readonly com: Vec3;
}

export function counterclockwise(points: readonly OnPlate[]): OnPlate[] {
  let area = 0;
  points.forEach((p, i) => {
    const q = points[(i + 1) % points.length] as OnPlate;
    area += p.x * q.y - p.y * q.x;
  });
  return area < 0 ? [...points].reverse() : [...points];
}

/** The tip angle towards a direction, degrees: as `tip_towards_rad` of the HTML report. */
export function tipTowardsDeg(balance: Balance, way: OnPlate): number {
  const {polygon, com} = balance;
  let reach = Infinity;
  polygon.forEach((p, i) => {
    const q = polygon[(i + 1) % polygon.length] as OnPlate;
    const length = Math.hypot(q.x - p.x, q.y - p.y);
    if (length < 1e-9) return;
    const inward = {x: -(q.y - p.y) / length, y: (q.x - p.x) / length};
    const outward = -(inward.x * way.x + inward.y * way.y);
    if (outward > 1e-9) reach = Math.min(reach, (inward.x * (com[0] - p.x) + inward.y * (com[1] - p.y)) / outward);
  });
  return (Math.atan2(reach, com[2]) * 180) / Math.PI;
}

/** The part of a convex polygon that is at least `distance` inside its edges. */
export function inset(polygon: readonly OnPlate[], distance: number): OnPlate[] {
  let left: OnPlate[] = [...polygon];
  polygon.forEach((p, i) => {
    const q = polygon[(i + 1) % polygon.length] as OnPlate;
    const length = Math.hypot(q.x - p.x, q.y - p.y);
    if (length < 1e-9) return;
    const inward = {x: -(q.y - p.y) / length, y: (q.x - p.x) / length};
    left = clipped(left, {x: p.x + distance * inward.x, y: p.y + distance * inward.y}, inward);
  });
  return left;
}

function clipped(polygon: readonly OnPlate[], from: OnPlate, inward: OnPlate): OnPlate[] {
  const kept: OnPlate[] = [];
  polygon.forEach((a, i) => {
    const b = polygon[(i + 1) % polygon.length] as OnPlate;
    const atA = inward.x * (a.x - from.x) + inward.y * (a.y - from.y);
    const atB = inward.x * (b.x - from.x) + inward.y * (b.y - from.y);
    if (atA >= 0) kept.push(a);
    if (atA >= 0 !== atB >= 0) {
      const t = atA / (atA - atB);
      kept.push({x: a.x + t * (b.x - a.x), y: a.y + t * (b.y - a.y)});
    }
  });
  return kept;
}

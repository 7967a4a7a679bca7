import {BufferGeometry, Color, DoubleSide, Float32BufferAttribute, Group, Mesh, MeshBasicMaterial} from 'three';

import {type Balance, type OnPlate, inset, tipTowardsDeg} from './balance';
import type {Inks} from './inks';
import {cleared, closed, haloed, line} from './lines';
import {shared} from './materials';

const directions = 144;
const mostShownDeg = 45, band = 0.3, least = 0.07; // of the ring's radius

/**
 * Where a bar of the ring ends, in radii from the middle: outward where it stands. By the square root, so that of small angles,
 * which matter most, more is seen; what falls is seen however little it lacks.
 */
export function barEnd(tipDeg: number): number {
  const length = band * Math.sqrt(Math.min(1, Math.abs(tipDeg) / mostShownDeg));
  return tipDeg < 0 ? 1 - Math.max(least, length) : 1 + length;
}

export interface GroundState {
  readonly balance: Balance;
  readonly weakEdge: readonly [OnPlate, OnPlate] | null;
  readonly askedDeg: number;
  readonly center: OnPlate; // of the ring
  readonly radius: number; // of the ring, mm
}

/** What is drawn on the plate: support polygon, the edge it tips over, and a ring of the tip angle by direction. */
export class GroundMarks {
  readonly group = new Group();

  show(state: GroundState | null, inks: Inks, ring: boolean): void {
    cleared(this.group);
    if (!state || state.balance.polygon.length < 3) return;
    const lift = 0.002 * state.radius;
    this.#support(state, inks, lift);
    if (ring) this.#ring(state, inks, lift);
  }

  #support({balance, weakEdge, askedDeg}: GroundState, inks: Inks, lift: number): void {
    const {polygon} = balance, flat = (points: readonly OnPlate[]) => points.flatMap((p) => [p.x, p.y, lift]);
    this.group.add(fan(polygon, lift / 2, inks.accent, 0.18));
    this.group.add(line(closed(flat(polygon)), {color: inks.accent, pixels: 2}));
    const safe = inset(polygon, balance.com[2] * Math.tan((askedDeg * Math.PI) / 180));
    const size = Math.hypot(...spread(polygon));
    if (safe.length > 2)
      this.group.add(line(closed(flat(safe)), {color: inks.good, pixels: 1.5, dash_mm: size / 30}));
    if (weakEdge) this.group.add(...haloed(flat(weakEdge), {color: inks.bad, pixels: 5, seenThrough: true}, inks.paper));
  }

  /** Outward of the circle: it stands to that angle; inward, and striped: it falls that way. */
  #ring({balance, askedDeg, center, radius}: GroundState, inks: Inks, lift: number): void {
    const reach = (deg: number) => radius * barEnd(deg);
    const at = (angle: number, r: number) => [center.x + r * Math.cos(angle), center.y + r * Math.sin(angle), lift];
    const circle = (r: number) => Array.from({length: directions + 1}, (_, n) => at((2 * Math.PI * n) / directions, r)).flat();
    const tips = Array.from({length: directions}, (_, n) => {
      const angle = (2 * Math.PI * (n + 0.5)) / directions;
      return tipTowardsDeg(balance, {x: Math.cos(angle), y: Math.sin(angle)});
    });
    const points: number[] = [], colors: number[] = [];
    tips.forEach((tip, n) => {
      if (tip < 0 && n % 2) return; // stripes where it falls
      const [from, to] = [(2 * Math.PI * n) / directions, (2 * Math.PI * (n + 1)) / directions] as const;
      const color = tip < 0 ? inks.bad : tip < askedDeg - 0.05 ? inks.mild : inks.good, r = reach(tip);
      points.push(...at(from, radius), ...at(from, r), ...at(to, r), ...at(from, radius), ...at(to, r), ...at(to, radius));
      for (let i = 0; i < 6; ++i) colors.push(color.r, color.g, color.b);
    });
    const geometry = new BufferGeometry().setAttribute('position', new Float32BufferAttribute(points, 3))
      .setAttribute('color', new Float32BufferAttribute(colors, 3));
    const material = shared('bars', [], () => new MeshBasicMaterial({vertexColors: true, side: DoubleSide, transparent: true, opacity: 0.85, depthWrite: false}));
    const bars = new Mesh(geometry, material);
    bars.renderOrder = 3;
    this.group.add(bars, line(circle(radius), {color: inks.ink, pixels: 1, opacity: 0.6}),
                   ...haloed(circle(reach(askedDeg)), {color: inks.ink, pixels: 1.5, dash_mm: radius / 25}, inks.paper));
  }
}

function spread(points: readonly OnPlate[]): [number, number] {
  const xs = points.map((p) => p.x), ys = points.map((p) => p.y);
  return [Math.max(...xs) - Math.min(...xs), Math.max(...ys) - Math.min(...ys)];
}

function fan(polygon: readonly OnPlate[], z: number, color: Color, opacity: number): Mesh {
  const points = polygon.flatMap((p) => [p.x, p.y, z]);
  const geometry = new BufferGeometry().setAttribute('position', new Float32BufferAttribute(points, 3));
  geometry.setIndex(Array.from({length: polygon.length - 2}, (_, i) => [0, i + 1, i + 2]).flat());
  const material = shared('fan', [color.getHex(), opacity], () => new MeshBasicMaterial({color, transparent: true, opacity, side: DoubleSide, depthWrite: false}));
  const mesh = new Mesh(geometry, material);
  mesh.renderOrder = 3;
  return mesh;
}

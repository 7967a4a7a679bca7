import {BufferAttribute, BufferGeometry, DynamicDrawUsage} from 'three';

import type {Vec3} from '../state/job';
import type {MeshData} from '../transport/frames';

const creaseCosine = Math.cos((38 * Math.PI) / 180);

/**
 * A triangle mesh that can be drawn and moved: with normals, and with a mark at vertices where the surface has an edge, so
 * that round parts are drawn round and edges sharp.
 */
export class Surface {
  readonly geometry = new BufferGeometry();
  readonly positions: Float32Array;
  readonly triangles: Uint32Array;
  /** The positions before any bend: those that a job speaks of. */
  readonly rest: Float32Array;
  readonly #normals: Float32Array;
  readonly #creases: Float32Array;
  /** What is painted on each vertex, as paint.ts numbers it. */
  readonly paint: Float32Array;

  constructor(mesh: MeshData) {
    this.rest = mesh.positions;
    this.positions = mesh.positions.slice();
    this.triangles = mesh.triangles;
    const vertices = this.positions.length / 3;
    this.#normals = new Float32Array(3 * vertices);
    this.#creases = new Float32Array(vertices);
    this.paint = new Float32Array(vertices);
    const {geometry} = this;
    geometry.setAttribute('position', new BufferAttribute(this.positions, 3).setUsage(DynamicDrawUsage));
    geometry.setAttribute('normal', new BufferAttribute(this.#normals, 3).setUsage(DynamicDrawUsage));
    geometry.setAttribute('crease', new BufferAttribute(this.#creases, 1));
    geometry.setAttribute('paint', new BufferAttribute(this.paint, 1));
    geometry.setIndex(new BufferAttribute(this.triangles, 1));
    this.#shade();
    geometry.computeBoundingSphere();
    geometry.computeBoundingBox();
  }

  /** Moves the vertices, or back to rest without positions. \return the largest way of one, mm. */
  move(positions: Float32Array | null): number {
    const to = positions ?? this.rest;
    this.positions.set(to);
    this.#shade();
    for (const name of ['position', 'normal', 'crease']) (this.geometry.getAttribute(name) as BufferAttribute).needsUpdate = true;
    let most = 0;
    for (let i = 0; positions && i < to.length; i += 3)
      most = Math.max(most, (to[i]! - this.rest[i]!) ** 2 + (to[i + 1]! - this.rest[i + 1]!) ** 2 + (to[i + 2]! - this.rest[i + 2]!) ** 2);
    return Math.sqrt(most);
  }

  painted(): void {
    (this.geometry.getAttribute('paint') as BufferAttribute).needsUpdate = true;
  }

  dispose(): void {
    this.geometry.dispose();
  }

  /** The lowest point along a direction of unit length. */
  lowest(x: number, y: number, z: number): number {
    let low = Infinity;
    for (let i = 0; i < this.positions.length; i += 3)
      low = Math.min(low, this.positions[i]! * x + this.positions[i + 1]! * y + this.positions[i + 2]! * z);
    return low;
  }

  /** The vertex that is farthest along a direction, before any bend. */
  farthest([x, y, z]: Vec3): Vec3 {
    let best = 0, most = -Infinity;
    for (let i = 0; i < this.rest.length; i += 3) {
      const far = this.rest[i]! * x + this.rest[i + 1]! * y + this.rest[i + 2]! * z;
      if (far > most) [best, most] = [i, far];
    }
    return [this.rest[best]!, this.rest[best + 1]!, this.rest[best + 2]!];
  }

  /** Six times the volume's sign: whether the triangles face outward. */
  facesOutward(): boolean {
    const p = this.positions, t = this.triangles;
    let volume = 0;
    for (let i = 0; i < t.length; i += 3) {
      const a = 3 * t[i]!, b = 3 * t[i + 1]!, c = 3 * t[i + 2]!;
      volume += p[a]! * (p[b + 1]! * p[c + 2]! - p[b + 2]! * p[c + 1]!) + p[a + 1]! * (p[b + 2]! * p[c]! - p[b]! * p[c + 2]!) +
        p[a + 2]! * (p[b]! * p[c + 1]! - p[b + 1]! * p[c]!);
    }
    return volume > 0;
  }

  /** Normals of the vertices, weighted by area, and where a triangle is far off them. */
  #shade(): void {
    const p = this.positions, t = this.triangles, n = this.#normals, faces = new Float32Array(t.length);
    n.fill(0);
    this.#creases.fill(0);
    for (let i = 0; i < t.length; i += 3) {
      const a = 3 * t[i]!, b = 3 * t[i + 1]!, c = 3 * t[i + 2]!;
      const ux = p[b]! - p[a]!, uy = p[b + 1]! - p[a + 1]!, uz = p[b + 2]! - p[a + 2]!;
      const vx = p[c]! - p[a]!, vy = p[c + 1]! - p[a + 1]!, vz = p[c + 2]! - p[a + 2]!;
      const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
      n[a]! += x, n[a + 1]! += y, n[a + 2]! += z;
      n[b]! += x, n[b + 1]! += y, n[b + 2]! += z;
      n[c]! += x, n[c + 1]! += y, n[c + 2]! += z;
      const length = Math.sqrt(x * x + y * y + z * z) || 1;
      faces[i] = x / length, faces[i + 1] = y / length, faces[i + 2] = z / length;
    }
    for (let i = 0; i < n.length; i += 3) {
      const length = Math.sqrt(n[i]! * n[i]! + n[i + 1]! * n[i + 1]! + n[i + 2]! * n[i + 2]!) || 1;
      n[i]! /= length, n[i + 1]! /= length, n[i + 2]! /= length;
    }
    for (let i = 0; i < t.length; ++i) {
      const v = 3 * t[i]!, f = i - (i % 3);
      if (n[v]! * faces[f]! + n[v + 1]! * faces[f + 1]! + n[v + 2]! * faces[f + 2]! < creaseCosine) this.#creases[v / 3] = 1;
    }
  }
}

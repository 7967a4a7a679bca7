import {type Plane, Vector3} from 'three';

import type {Surface} from './surface';

/** Where a plane cuts a surface: ends of segments, x, y, z each. The plane is in the coordinates of the surface. */
export function outlineOf({positions: p, triangles: t}: Surface, {normal: n, constant}: Plane): number[] {
  const above = new Float32Array(p.length / 3), found: number[] = [];
  for (let v = 0, i = 0; i < p.length; ++v, i += 3) above[v] = n.x * p[i]! + n.y * p[i + 1]! + n.z * p[i + 2]! + constant;
  const cross = (a: number, b: number) => {
    if (above[a]! >= 0 === above[b]! >= 0) return;
    const share = above[a]! / (above[a]! - above[b]!);
    for (let k = 0; k < 3; ++k) found.push(p[3 * a + k]! + share * (p[3 * b + k]! - p[3 * a + k]!));
  };
  for (let i = 0; i < t.length; i += 3) {
    const a = t[i]!, b = t[i + 1]!, c = t[i + 2]!;
    cross(a, b), cross(b, c), cross(c, a); // two of them, or none
  }
  return found;
}

/** The planes of a convex surface's faces, each once, as a, b, c, d with a x + b y + c z + d >= 0 inside. */
export function facesOf({rest: p, triangles: t}: Surface): number[][] {
  const corner = (v: number) => new Vector3().fromArray(p, 3 * v), middle = new Vector3(), faces: number[][] = [];
  for (let v = 0; v < p.length / 3; ++v) middle.addScaledVector(corner(v), 3 / p.length);
  for (let i = 0; i < t.length; i += 3) {
    const [a, b, c] = [corner(t[i]!), corner(t[i + 1]!), corner(t[i + 2]!)] as const;
    const normal = b.clone().sub(a).cross(c.clone().sub(a)).normalize();
    if (normal.dot(middle.clone().sub(a)) < 0) normal.negate();
    const face = [...normal.toArray(), -normal.dot(a)], size = Math.max(1, a.length());
    if (normal.lengthSq() > 0.5 && !faces.some((other) => other.every((value, k) => Math.abs(value - face[k]!) < (k < 3 ? 1e-4 : 1e-4 * size))))
      faces.push(face);
  }
  return faces;
}

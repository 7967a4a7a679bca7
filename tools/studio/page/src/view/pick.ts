import {type BufferGeometry, DoubleSide, type Face, Matrix4, type Ray, Raycaster, Triangle, Vector2, Vector3} from 'three';
import {MeshBVH} from 'three-mesh-bvh';

import type {Vec3} from '../state/job';
import type {Figure} from './figure';
import type {Stage} from './stage';
import type {Surface} from './surface';

export interface Hit {
  readonly at: Vector3; // on the plate of the pose
  readonly placed: Vec3; // in placed coordinates, of the model before any bend
  readonly shown: Vec3; // the same as it is bent
  readonly normal: Vector3; // outward, in placed coordinates
}

/** Finds what is under the pointer. The tree is built when it is first needed and refitted when the surface has moved. */
export class Picker {
  #tree: MeshBVH | null = null;
  #of: BufferGeometry | null = null;
  #moved = false;
  readonly #caster = new Raycaster();

  constructor(private readonly stage: Stage, private readonly figure: Figure) {}

  /** The surface has moved. */
  moved(): void {
    this.#moved = true;
  }

  ray(x: number, y: number): Raycaster {
    const box = this.stage.canvas.getBoundingClientRect();
    const at = new Vector2(((x - box.left) / box.width) * 2 - 1, 1 - ((y - box.top) / box.height) * 2);
    this.stage.camera.updateMatrixWorld(); // it may not have been drawn since it moved
    this.#caster.setFromCamera(at, this.stage.camera);
    return this.#caster;
  }

  /** What lies under a point of the window. */
  at(x: number, y: number): Hit | null {
    const surface = this.figure.outside;
    if (!surface) return null;
    const {pose} = this.figure, seen = this.ray(x, y).ray, [near, far] = this.#shown(seen);
    const ray = seen.clone().applyMatrix4(new Matrix4().copy(pose.matrixWorld).invert());
    const hit = near < far ? this.#treeOf(surface.geometry).raycastFirst(ray, DoubleSide, near, far) : null;
    if (!hit?.face || hit.face.normal.dot(ray.direction) >= 0) return null; // from within: it is the face of a cut
    return {
      at: hit.point.clone().applyMatrix4(pose.matrixWorld), placed: atRest(surface, hit.face, hit.point), shown: hit.point.toArray(),
      normal: hit.face.normal.clone(),
    };
  }

  /** From where to where a line of sight is on the side of the cut that is shown, mm. */
  #shown(ray: Ray): readonly [near: number, far: number] {
    const {caps, section: {plane}} = this.figure;
    if (!caps.children.some((cap) => cap.visible)) return [0, Infinity];
    const depth = plane.distanceToPoint(ray.origin), speed = plane.normal.dot(ray.direction), at = -depth / speed;
    if (depth >= 0) return [0, speed < 0 ? at : Infinity];
    return speed > 0 ? [at, Infinity] : [0, 0];
  }

  #treeOf(geometry: BufferGeometry): MeshBVH {
    if (!this.#tree || this.#of !== geometry) {
      this.#tree = new MeshBVH(geometry, {indirect: true});
      this.#of = geometry;
    } else if (this.#moved) {
      this.#tree.refit();
    }
    this.#moved = false;
    return this.#tree;
  }
}

/** Where a point of a face was before any bend. */
function atRest(surface: Surface, face: Face, point: Vector3): Vec3 {
  const corners = [face.a, face.b, face.c] as const;
  const now = corners.map((v) => new Vector3().fromArray(surface.positions, 3 * v)) as [Vector3, Vector3, Vector3];
  const shares = Triangle.getBarycoord(point, ...now, new Vector3())?.toArray() ?? [1, 0, 0];
  const rest = corners.reduce((sum, v, i) => sum.addScaledVector(new Vector3().fromArray(surface.rest, 3 * v), shares[i]!), new Vector3());
  return rest.toArray();
}

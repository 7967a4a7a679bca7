import {type BufferGeometry, Matrix4, Raycaster, Vector2, Vector3} from 'three';
import {MeshBVH} from 'three-mesh-bvh';

import type {Vec3} from '../state/job';
import type {Figure} from './figure';
import type {Stage} from './stage';

export interface Hit {
  readonly at: Vector3; // on the plate of the pose
  readonly placed: Vec3; // in placed coordinates
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
    const {pose} = this.figure;
    const ray = this.ray(x, y).ray.clone().applyMatrix4(new Matrix4().copy(pose.matrixWorld).invert());
    const hit = this.#treeOf(surface.geometry).raycastFirst(ray);
    if (!hit?.face) return null;
    const {point} = hit;
    return {
      at: point.clone().applyMatrix4(pose.matrixWorld), placed: [point.x, point.y, point.z], normal: hit.face.normal.clone(),
    };
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

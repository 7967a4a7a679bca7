import {
  AlwaysStencilFunc, BackSide, type BufferAttribute, Color, DecrementWrapStencilOp, DoubleSide, EqualStencilFunc, FrontSide, Group,
  IncrementWrapStencilOp, KeepStencilOp, Mesh, MeshBasicMaterial, Plane, PlaneGeometry, type Side,
  ShaderMaterial, type StencilOp, Vector3,
} from 'three';

import type {CutAxis} from '../state/ui';
import type {Inks} from './inks';
import {cleared, segments} from './lines';
import {outlineOf} from './outline';
import type {Surface} from './surface';


const normals: Record<CutAxis, Vector3> = {
  x: new Vector3(-1, 0, 0), y: new Vector3(0, 1, 0), z: new Vector3(0, 0, -1),
};

/**
 * A plane that cuts the figure open. Walls are hatched and outlined as on a drawing, dense infill is hatched across, voids stay
 * open.
 *
 * The stencil counts how often a pixel's line of sight goes in and out behind the plane: outer surfaces add one, voids take
 * it away, so it is one exactly where there is wall; dense infill adds one more, and counts where that makes two.
 */
export class Section {
  readonly plane = new Plane(normals.y.clone(), 0);
  readonly #wall: Mesh;
  readonly #dense: Mesh;
  #counters: Mesh[] = [];
  readonly #outline = new Group(); // in the coordinates of what is cut
  #outlined: readonly Surface[] = [];
  #drawn = '';
  #ink = new Color();

  /** `parent`: of what is cut; `plate`: of the cut's faces, in whose coordinates the plane is. */
  constructor(private readonly parent: Group, plate: Group) {
    this.#wall = cap(1, 1.2);
    this.#dense = cap(2, 2.2);
    plate.add(this.#wall, this.#dense);
    parent.add(this.#outline);
    this.show(false);
  }

  paint(inks: Inks): void {
    this.#ink = inks.ink;
    this.#drawn = '';
    for (const [mesh, cross] of [[this.#wall, 0], [this.#dense, 1]] as const) {
      const {uniforms} = mesh.material as ShaderMaterial;
      (uniforms.ground!.value as Color).copy(inks.cut);
      (uniforms.line!.value as Color).copy(cross ? inks.dense : inks.cutLine);
      uniforms.across!.value = cross;
    }
  }

  /** Counts with these surfaces; `inward`: its triangles face away from the matter. */
  setSurfaces(outside: Surface, voids: readonly Surface[], dense: Surface | null): void {
    for (const mesh of this.#counters) {
      this.parent.remove(mesh);
      (mesh.material as MeshBasicMaterial).dispose();
    }
    this.#counters = [...this.#counting(outside, true, 1), ...voids.flatMap((one) => this.#counting(one, false, 1)),
                      ...(dense ? this.#counting(dense, true, 2) : [])];
    this.parent.add(...this.#counters);
    this.#outlined = [outside, ...voids];
    this.#drawn = '';
    this.show(this.#wall.visible);
    this.#dense.userData.any = dense !== null;
  }

  show(visible: boolean): void {
    for (const part of [...this.#counters, this.#wall, this.#outline]) part.visible = visible;
    this.#dense.visible = visible && this.#dense.userData.any === true;
  }

  /** Cuts across `axis` at `at` mm; what is on the side of the viewer goes. `size`: of the figure, mm. */
  cut(axis: CutAxis, at: number, center: Vector3, size: number): void {
    const normal = normals[axis];
    this.plane.normal.copy(normal);
    this.plane.constant = -normal[axis] * at;
    for (const mesh of [this.#wall, this.#dense]) {
      this.plane.projectPoint(center, mesh.position);
      mesh.quaternion.setFromUnitVectors(new Vector3(0, 0, 1), normal.clone().negate());
      mesh.scale.setScalar(3 * size);
      ((mesh.material as ShaderMaterial).uniforms.pitch!).value = (3 * size) / (size / 34);
    }
    if (this.#outline.visible) this.#drawOutline(size);
  }

  /** Draws where the plane meets the surfaces, if that is not drawn yet; a little on the viewer's side of the cut's faces. */
  #drawOutline(size: number): void {
    this.parent.updateWorldMatrix(true, false);
    const inside = this.parent.matrixWorld.clone().invert(), plane = this.plane.clone().applyMatrix4(inside);
    const versions = this.#outlined.map(({geometry}) => (geometry.getAttribute('position') as BufferAttribute).version);
    const wanted = JSON.stringify([plane.normal, plane.constant, versions]);
    if (wanted === this.#drawn) return;
    this.#drawn = wanted;
    cleared(this.#outline);
    const ends = this.#outlined.flatMap((surface) => outlineOf(surface, plane)), nearer = plane.normal.clone().multiplyScalar(-0.001 * size);
    if (ends.length) this.#outline.add(segments(ends, {color: this.#ink, pixels: 1.5}));
    this.#outline.position.copy(nearer);
  }

  #counting(surface: Surface, matter: boolean, round: number): Mesh[] {
    const adds = surface.facesOutward() === matter;
    return [this.#counter(surface, BackSide, adds ? IncrementWrapStencilOp : DecrementWrapStencilOp, round),
            this.#counter(surface, FrontSide, adds ? DecrementWrapStencilOp : IncrementWrapStencilOp, round)];
  }

  #counter(surface: Surface, side: Side, op: StencilOp, round: number): Mesh {
    const material = new MeshBasicMaterial({
      side, clippingPlanes: [this.plane], colorWrite: false, depthWrite: false, depthTest: false, stencilWrite: true,
      stencilFunc: AlwaysStencilFunc, stencilFail: op, stencilZFail: op, stencilZPass: op,
    });
    const mesh = new Mesh(surface.geometry, material);
    mesh.renderOrder = round;
    return mesh;
  }
}

/** A plane that is drawn where the stencil has counted to a number. Each picture begins with an empty stencil. */
function cap(count: number, order: number): Mesh {
  const material = new ShaderMaterial({
    uniforms: {ground: {value: new Color()}, line: {value: new Color()}, across: {value: 0}, pitch: {value: 100}},
    vertexShader: 'varying vec2 at; void main() { at = uv; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }',
    fragmentShader: `varying vec2 at; uniform vec3 ground; uniform vec3 line; uniform float across; uniform float pitch;
      float stroke(float t) { float w = fwidth(t); float d = abs(fract(t) - 0.5); return 1.0 - smoothstep(0.055, 0.055 + w, d); }
      void main() {
        float s = stroke((at.x + at.y) * pitch);
        if (across > 0.5) s = max(s, stroke((at.x - at.y) * pitch));
        gl_FragColor = vec4(mix(ground, line, s), 1.0);
        #include <colorspace_fragment>
      }`,
    side: DoubleSide, stencilWrite: true, stencilRef: count, stencilFunc: EqualStencilFunc,
    stencilFail: KeepStencilOp, stencilZFail: KeepStencilOp, stencilZPass: KeepStencilOp,
    polygonOffset: count === 2, polygonOffsetFactor: -1, polygonOffsetUnits: -1,
  });
  const mesh = new Mesh(new PlaneGeometry(1, 1), material);
  mesh.renderOrder = order;
  return mesh;
}

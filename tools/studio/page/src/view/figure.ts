import {BackSide, Box3, type Color, DoubleSide, Group, Mesh, type MeshLambertMaterial, Quaternion, Vector3} from 'three';

import {turnUpright} from '../state/placement';
import type {Vec3} from '../state/job';
import type {Look} from '../state/ui';
import type {MeshData} from '../transport/frames';
import {clay} from './clay';
import type {Inks} from './inks';
import {facesOf} from './outline';
import {Section} from './section';
import {Surface} from './surface';

export interface Surfaces {
  readonly outside: MeshData;
  readonly voids: readonly MeshData[];
  readonly dense: MeshData | null;
}

/** The model as it is shown: its outside, voids and dense infill, put upright for a pose; solid, seen through, or cut. */
export class Figure {
  readonly pose = new Group(); // from placed coordinates to the plate of the pose
  readonly caps = new Group(); // of the section, on the plate
  readonly section: Section;
  outside: Surface | null = null;
  #voids: Surface[] = [];
  #dense: Surface | null = null;
  #shown: Surfaces | null = null;
  #meshes: Mesh[] = [];
  #inks: Inks | null = null;
  #look: Look = 'solid';
  #box: Box3 | null = null; // of what is shown as it stands, once it was asked for
  #stance = '';

  constructor() {
    this.section = new Section(this.pose, this.caps);
  }

  /** Shows other surfaces. \return whether they are others than before. */
  show(surfaces: Surfaces | null): boolean {
    if (surfaces === this.#shown || (surfaces && this.#shown && same(surfaces, this.#shown))) return false;
    this.#shown = surfaces;
    this.#box = null;
    for (const old of [this.outside, ...this.#voids, this.#dense]) old?.dispose();
    this.outside = surfaces && new Surface(surfaces.outside);
    this.#voids = surfaces?.voids.map((mesh) => new Surface(mesh)) ?? [];
    this.#dense = surfaces?.dense ? new Surface(surfaces.dense) : null;
    if (this.outside) this.section.setSurfaces(this.outside, this.#voids, this.#dense);
    this.#build();
    return true;
  }

  get hasInside(): boolean {
    return this.#voids.length > 0 || this.#dense !== null;
  }

  /** Moves the outside's vertices, or back to rest. \return the largest way of one, mm. */
  bend(positions: Float32Array | null): number {
    this.#box = null;
    return this.outside?.move(positions) ?? 0;
  }

  /** Turns it so that `up` points up, and sets it down at `lift` mm over the plate. */
  stand(up: Vec3, lift: number): void {
    const stance = JSON.stringify([up, lift]);
    this.pose.updateWorldMatrix(true, true); // what it stands in may just have been put back
    if (this.#box && this.#stance === stance) return;
    this.#stance = stance;
    this.#box = null;
    this.pose.quaternion.copy(turnUpright(up));
    const low = new Vector3(0, 0, 1).applyQuaternion(this.pose.quaternion.clone().invert());
    const lowest = this.outside?.lowest(low.x, low.y, low.z) ?? 0;
    this.pose.position.set(0, 0, Number.isFinite(lowest) ? lift - lowest : 0);
    this.pose.updateWorldMatrix(true, true);
  }

  /** Its box on the plate of the pose. */
  box(): Box3 {
    this.#box ??= this.#measured();
    return this.#box.clone();
  }

  #measured(): Box3 {
    const box = new Box3(), at = new Vector3(), turn = new Quaternion().copy(this.pose.quaternion);
    const p = this.outside?.positions ?? [];
    for (let i = 0; i < p.length; i += 3) box.expandByPoint(at.fromArray(p, i).applyQuaternion(turn));
    return box.translate(this.pose.position);
  }

  look(look: Look): void {
    if (look === this.#look) return;
    this.#look = look;
    this.#build();
  }

  paint(inks: Inks): void {
    this.#inks = inks;
    this.section.paint(inks);
    this.#build();
  }

  #build(): void {
    for (const mesh of this.#meshes) {
      this.pose.remove(mesh);
      (mesh.material as MeshLambertMaterial).dispose();
    }
    this.#meshes = [];
    const inks = this.#inks, {outside} = this;
    this.section.show(this.#look === 'section' && outside !== null);
    if (!inks || !outside) return;
    const clip = this.#look === 'section' ? [this.section.plane] : [];
    const xray = this.#look === 'xray';
    this.#add(outside, xray ? inks.glass : inks.model, {opacity: xray ? 0.25 : 1, clip}, xray ? 8 : 0);
    if (xray) this.#add(outside, inks.glass, {opacity: 0.15, side: BackSide}, 7);
    if (this.#look === 'solid') return;
    for (const one of this.#voids) this.#add(one, inks.void, {side: DoubleSide, clip}, 0);
    if (this.#dense && xray) this.#add(outside, inks.dense, {opacity: 0.8, side: DoubleSide, within: facesOf(this.#dense)}, 9);
  }

  #add(surface: Surface, color: Color, options: Parameters<typeof clay>[1], order: number): void {
    const material = clay(color, options);
    (material.userData.patternInk as {value: Color}).value.copy(this.#inks?.mark ?? color);
    const mesh = new Mesh(surface.geometry, material);
    mesh.renderOrder = order;
    this.#meshes.push(mesh);
    this.pose.add(mesh);
  }
}

function same(a: Surfaces, b: Surfaces): boolean {
  return a.outside === b.outside && a.dense === b.dense && a.voids.length === b.voids.length &&
    a.voids.every((mesh, i) => mesh === b.voids[i]);
}

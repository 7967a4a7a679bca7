import {type Box3, Group, LineBasicMaterial, LineSegments, BufferGeometry, Float32BufferAttribute, Mesh, MeshBasicMaterial, PlaneGeometry} from 'three';

import type {Inks} from './inks';
import {cleared} from './lines';
import {shared} from './materials';

/** The build plate: a sheet with a line each 10 mm, as large as the figure needs. */
export class Plate {
  readonly group = new Group();
  #half = 0;

  /** Lays the plate under a box. */
  lay(box: Box3, inks: Inks): void {
    cleared(this.group);
    if (box.isEmpty()) return;
    const largest = Math.max(box.max.x - box.min.x, box.max.y - box.min.y, 0.6 * box.max.z);
    const step = 10 ** Math.max(0, Math.round(Math.log10(largest / 12)));
    this.#half = step * Math.ceil((0.95 * largest) / step);
    const x = step * Math.round((box.min.x + box.max.x) / 2 / step), y = step * Math.round((box.min.y + box.max.y) / 2 / step);
    this.group.position.set(x, y, -0.0005 * largest);
    const sheet = new Mesh(new PlaneGeometry(2 * this.#half, 2 * this.#half), shared('plate', [inks.plate.getHex()], () => new MeshBasicMaterial({
      color: inks.plate, polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 2,
    })));
    sheet.renderOrder = -2;
    const lines = new LineSegments(this.#lines(step), shared('grid', [inks.grid.getHex()], () => new LineBasicMaterial({color: inks.grid})));
    lines.renderOrder = -1;
    this.group.add(sheet, lines);
  }

  #lines(step: number): BufferGeometry {
    const half = this.#half, points: number[] = [];
    for (let at = -half; at <= half + 1e-9; at += step)
      points.push(at, -half, 0, at, half, 0, -half, at, 0, half, at, 0);
    return new BufferGeometry().setAttribute('position', new Float32BufferAttribute(points, 3));
  }
}

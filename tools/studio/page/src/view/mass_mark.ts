import {CanvasTexture, Group, Sprite, SpriteMaterial, SRGBColorSpace, type Vector3} from 'three';

import type {Inks} from './inks';
import {cleared, haloed} from './lines';
import {shared} from './materials';

/** A centre of mass: the quartered disc of drawings, its plumb line and where that meets the plate. */
export class MassMark {
  readonly group = new Group();

  /** `before`: drawn hollow and thin, as what was. Points in mm of the plate. */
  show(at: Vector3 | null, inks: Inks, size: number, before: boolean, plumbTo = 0): void {
    cleared(this.group);
    if (!at) return;
    const color = before ? inks.mild : inks.ink, pixels = before ? 1.5 : 2.5, arm = size * (before ? 0.02 : 0.03);
    const stroke = {color, pixels, seenThrough: true, opacity: before ? 0.9 : 1};
    this.group.add(...haloed([at.x, at.y, at.z, at.x, at.y, plumbTo], {...stroke, dash_mm: before ? size / 60 : 0}, inks.paper),
                   ...haloed([at.x - arm, at.y, plumbTo, at.x + arm, at.y, plumbTo], stroke, inks.paper),
                   ...haloed([at.x, at.y - arm, plumbTo, at.x, at.y + arm, plumbTo], stroke, inks.paper));
    const sprite = new Sprite(shared('disc', [inks.ink.getHex(), inks.paper.getHex(), inks.mild.getHex(), before],
                                     () => new SpriteMaterial({map: disc(inks, before), depthTest: false, sizeAttenuation: false})));
    sprite.position.copy(at);
    sprite.scale.setScalar(before ? 0.016 : 0.021);
    sprite.renderOrder = before ? 21 : 22;
    this.group.add(sprite);
  }
}

function disc(inks: Inks, before: boolean): CanvasTexture {
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = 64;
  const pen = canvas.getContext('2d') as CanvasRenderingContext2D;
  const ink = `#${inks.ink.getHexString()}`, paper = `#${inks.paper.getHexString()}`;
  pen.fillStyle = paper;
  pen.beginPath();
  pen.arc(32, 32, 29, 0, 2 * Math.PI);
  pen.fill();
  pen.fillStyle = ink;
  for (const from of before ? [] : [0, Math.PI]) {
    pen.beginPath();
    pen.moveTo(32, 32);
    pen.arc(32, 32, 28, from, from + Math.PI / 2);
    pen.fill();
  }
  pen.lineWidth = before ? 8 : 5;
  pen.strokeStyle = before ? `#${inks.mild.getHexString()}` : ink;
  pen.beginPath();
  pen.arc(32, 32, 28, 0, 2 * Math.PI);
  pen.stroke();
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = SRGBColorSpace;
  return texture;
}

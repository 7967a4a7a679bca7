import {Vector3} from 'three';

import {turnUpright} from '../state/placement';
import type {Vec3} from '../state/job';

const ways = ['to the right', 'to the back right', 'backwards', 'to the back left', 'to the left', 'to the front left',
              'forwards', 'to the front right'] as const;

/** A direction on the plate as seen from the front, which is the plate's -y side. */
export function wayOf(heading: Vec3, up: Vec3): string {
  const shown = new Vector3(...heading).applyQuaternion(turnUpright(up));
  const eighth = Math.round(Math.atan2(shown.y, shown.x) / (Math.PI / 4));
  return ways[(eighth + 8) % 8] as string;
}

/** An angle to a tenth of a degree, with a real minus and never as -0.0. */
export function degrees(angle: number): string {
  const text = Math.abs(angle).toFixed(1);
  return angle < 0 && text !== '0.0' ? `\u2212${text}` : text;
}

/** A number of three digits or so. */
export function brief(value: number): string {
  const size = Math.abs(value);
  const text = size >= 100 ? value.toFixed(0) : size >= 10 ? value.toFixed(1) : value.toFixed(2);
  return text.replace('-', '\u2212');
}

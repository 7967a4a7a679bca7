import type {Vector3} from 'three';

import {type Place, besides} from './callouts';
import type {Stage} from './stage';

/** What of the room is free of tools, hint and bar, which float over the scene. */
const inset = {left: 100, top: 56, right: 20, bottom: 70};

interface Callout {
  readonly leader: readonly SVGPathElement[]; // its halo, and the line
  at: Vector3;
  off: Place | undefined; // where it was put, from its point
}

/**
 * Elements of the page that stay at points of the scene, or beside them with a line to the point. They are placed before a picture is
 * drawn, and ask for none.
 */
export class Labels {
  readonly #placed = new Map<HTMLElement, Vector3>();
  readonly #beside = new Map<HTMLElement, Callout>();
  readonly #leaders = drawing('svg', 'leaders');

  constructor(private readonly stage: Stage, private readonly room: HTMLElement) {
    this.#leaders.setAttribute('aria-hidden', 'true');
    room.append(this.#leaders);
    stage.beforeDraw.add(() => this.#follow());
  }

  put(element: HTMLElement, at: Vector3): void {
    if (!element.isConnected) this.room.append(element);
    this.#placed.set(element, at.clone());
  }

  /** Where it covers neither its point nor others. */
  putBeside(element: HTMLElement, at: Vector3): void {
    const known = this.#beside.get(element);
    if (known) known.at = at.clone();
    else {
      const leader = ['halo', 'line'].map((name) => drawing('path', name));
      this.#leaders.append(...leader);
      this.room.append(element);
      this.#beside.set(element, {leader, at: at.clone(), off: undefined});
    }
  }

  remove(element: HTMLElement): void {
    element.remove();
    this.#placed.delete(element);
    for (const path of this.#beside.get(element)?.leader ?? []) path.remove();
    this.#beside.delete(element);
  }

  #follow(): void {
    this.stage.camera.updateMatrixWorld();
    const taken: Place[] = [];
    for (const [element, at] of this.#placed) {
      const seen = this.stage.onScreen(at);
      element.hidden = seen === null;
      if (!seen) continue;
      moveTo(element, seen);
      taken.push(seen);
    }
    if (this.#beside.size) this.#followBeside(taken);
  }

  #followBeside(taken: readonly Place[]): void {
    const {clientWidth: width, clientHeight: height} = this.stage.canvas;
    const shown = [...this.#beside].flatMap(([element, callout]) => {
      const point = this.stage.onScreen(callout.at);
      const isIn = point !== null && point.x >= 0 && point.y >= 0 && point.x <= width && point.y <= height;
      element.hidden = !isIn;
      for (const path of callout.leader) path.style.display = isIn ? '' : 'none';
      return isIn ? [{element, callout, point}] : [];
    });
    const free = {left: inset.left, top: inset.top, right: width - inset.right, bottom: height - inset.bottom};
    const places = besides(shown.map(({point}) => point), shown.map(({callout}) => callout.off), {free, taken});
    shown.forEach(({element, callout, point}, index) => {
      const at = places[index]!;
      callout.off = {x: at.x - point.x, y: at.y - point.y};
      moveTo(element, at);
      const line = `M${at.x.toFixed(1)} ${at.y.toFixed(1)}L${point.x.toFixed(1)} ${point.y.toFixed(1)}`;
      for (const path of callout.leader) path.setAttribute('d', `${line}m-2.5 0a2.5 2.5 0 1 0 5 0a2.5 2.5 0 1 0-5 0`);
    });
  }
}

function drawing<K extends keyof SVGElementTagNameMap>(tag: K, name: string): SVGElementTagNameMap[K] {
  const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
  element.setAttribute('class', name);
  return element;
}

function moveTo(element: HTMLElement, {x, y}: Place): void {
  element.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px) translate(-50%, -50%)`;
}

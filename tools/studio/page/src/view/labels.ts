import type {Vector3} from 'three';

import type {Stage} from './stage';

/** Elements of the page that stay at points of the scene. */
export class Labels {
  readonly #placed = new Map<HTMLElement, Vector3>();

  constructor(private readonly stage: Stage, private readonly room: HTMLElement) {
    stage.beforeDraw.add(() => this.#follow());
  }

  put(element: HTMLElement, at: Vector3): void {
    if (!element.isConnected) this.room.append(element);
    this.#placed.set(element, at.clone());
    this.stage.invalidate();
  }

  remove(element: HTMLElement): void {
    element.remove();
    this.#placed.delete(element);
  }

  #follow(): void {
    this.stage.camera.updateMatrixWorld();
    for (const [element, at] of this.#placed) {
      const seen = this.stage.onScreen(at);
      element.hidden = seen === null;
      if (seen) element.style.transform = `translate(${seen.x.toFixed(1)}px, ${seen.y.toFixed(1)}px) translate(-50%, -50%)`;
    }
  }
}

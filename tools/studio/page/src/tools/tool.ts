import type {Conductor} from '../results/conductor';
import type {ResultsStore} from '../results/results';
import type {DocumentStore} from '../state/document';
import type {UiStore} from '../state/ui';
import type {View} from '../view/view';

/** What a tool works with. */
export interface Bench {
  readonly documents: DocumentStore;
  readonly results: ResultsStore;
  readonly ui: UiStore;
  readonly view: View;
  readonly conductor: Conductor;
}

/** What a hand does to the model. Positions are those of the window, in pixels. */
export interface Tool {
  readonly hint: string;
  /** \return whether the tool takes this press; else it turns the view. */
  down?(x: number, y: number, event: PointerEvent): boolean;
  drag?(x: number, y: number, event: PointerEvent): void;
  up?(x: number, y: number, event: PointerEvent): void;
  hover?(x: number, y: number): void;
  /** Takes back what is being done. \return whether there was anything. */
  cancel?(): boolean;
  begin?(): void;
  end?(): void;
}

/** The height of the model as it is placed, mm. */
export function heightOf(results: ResultsStore): number {
  const box = results.value.placed?.placed.box_mm;
  return box ? Math.max(1e-6, box[1][2] - box[0][2]) : 100;
}

/** The radius of brush, contact and handle, mm. */
export function brushOf(bench: Bench): number {
  return Math.round(heightOf(bench.results) * bench.ui.value.brushPercent * 10) / 1000;
}

export const tenth = (value: number) => Math.round(value * 100) / 100 + 0;

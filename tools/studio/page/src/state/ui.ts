import {Signal} from './signal';

export type ToolName = 'look' | 'face' | 'turn' | 'touch' | 'handle' | 'lock';
export type CutAxis = 'x' | 'y' | 'z';
export type Look = 'solid' | 'xray' | 'section';

/** How the document is looked at and worked on: no part of the job, so no part of undo. */
export interface Ui {
  readonly pose: number;
  readonly look: Look;
  readonly cutAxis: CutAxis;
  readonly cutAt: number; // 0 to 1 of the figure
  readonly ring: boolean;
  readonly tool: ToolName;
  readonly handle: number | null; // the one that has the gizmo
  readonly brushPercent: number; // of the height
  readonly finding: number | null;
  readonly atOnce: boolean | null; // make it stand whenever the hand rests; null: nobody has said, and no handle was dragged
}

export const firstUi: Ui = {
  pose: 0, look: 'solid', cutAxis: 'y', cutAt: 0.5, ring: true, tool: 'look', handle: null, brushPercent: 6, finding: null,
  atOnce: null,
};

const speaksOfModel: readonly ToolName[] = ['face', 'touch', 'handle', 'lock'];

/** Whether a tool takes its points from the surface: those of a job are of the model before any bend. */
export function takesPoints(tool: ToolName): boolean {
  return speaksOfModel.includes(tool);
}

export type UiStore = Signal<Ui>;

export const newUi = (): UiStore => new Signal<Ui>(firstUi);

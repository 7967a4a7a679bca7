import type {Asked} from '../state/document';
import type {Job} from '../state/job';
import {Signal} from '../state/signal';
import type {MeshData} from '../transport/frames';
import type {Judgement, Placed, Preview, Report} from './report';

/** The body of a request. */
export function bodyOf({model, profile, job}: Asked): {model?: number; profile?: number; job: Job} {
  return {model: model?.id, profile: profile?.id, job};
}

/** What a result belongs to: one model with one job, as text to be compared. */
export function keyOf(asked: Asked): string {
  return JSON.stringify(bodyOf(asked));
}

export interface PlacedResult {
  readonly key: string; // of model and placement
  readonly placed: Placed;
  readonly mesh: MeshData;
}

export interface CheckResult {
  readonly key: string;
  readonly report: Report;
  readonly message: string;
}

export interface PreviewResult {
  readonly key: string;
  readonly preview: Preview;
  readonly positions: Float32Array | null;
}

export interface StandResult extends CheckResult {
  readonly outside: MeshData | null;
  readonly voids: readonly MeshData[];
  readonly dense: MeshData | null;
  readonly isWritten: boolean; // the meshes may be taken
  readonly code: number | null; // the program's exit code, once it has ended
}

export interface JudgementResult {
  readonly key: string;
  readonly of: 'model' | 'result';
  readonly judgement: Judgement;
}

/** What is being done that takes long enough to be told. */
export interface Busy {
  readonly what: 'read' | 'open' | 'stand' | 'validate';
  readonly fraction: number | null;
  readonly stage: string;
}

export interface Notice {
  readonly tone: 'error' | 'note';
  readonly sentence: string;
}

/** The one store of what came from the server; each result says what it is of, so none is shown for another job. */
export interface Results {
  readonly placed: PlacedResult | null;
  readonly check: CheckResult | null;
  readonly preview: PreviewResult | null;
  readonly stand: StandResult | null;
  readonly judgement: JudgementResult | null;
  readonly busy: Busy | null;
  readonly notice: Notice | null;
  readonly failed: string | null; // the key of what was asked for in vain
  readonly previewsPerSecond: number | null; // of the last drag
}

export const nothing: Results = {
  placed: null, check: null, preview: null, stand: null, judgement: null, busy: null, notice: null, failed: null,
  previewsPerSecond: null,
};

export type ResultsStore = Signal<Results>;

/** The result of the last run, if it is of this job. */
export function freshStand(results: Results, asked: Asked): StandResult | null {
  return results.stand && results.stand.key === keyOf(asked) ? results.stand : null;
}

/** Whether what was made of this job is of another shape than the model, of which the job speaks. */
export function isBent(results: Results, asked: Asked): boolean {
  const stand = freshStand(results, asked);
  return stand?.outside != null && stand.report.deformation != null;
}

export function freshCheck(results: Results, asked: Asked): CheckResult | null {
  return results.check && results.check.key === keyOf(asked) ? results.check : null;
}

export function freshPreview(results: Results, asked: Asked): PreviewResult | null {
  return results.preview && results.preview.key === keyOf(asked) ? results.preview : null;
}

/** Whether there will be no verdict of this job unless it is asked for again. */
export function isUnanswered(results: Results, asked: Asked): boolean {
  return results.failed === keyOf(asked);
}

/** The judgement to be shown: of the run that was asked for, or of the model as it came. */
export function shownJudgement(results: Results, of: Asked): JudgementResult | null {
  const key = keyOf(of), stand = freshStand(results, of), asked = results.judgement?.key === key ? results.judgement : null;
  if (!stand?.outside) return asked;
  const judged = stand.report.judgement;
  return judged ? {key, of: 'result', judgement: judged} : asked?.of === 'result' ? asked : null;
}

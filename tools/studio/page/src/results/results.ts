import type {Doc} from '../state/document';
import {Signal} from '../state/signal';
import type {MeshData} from '../transport/frames';
import type {Judgement, Placed, Preview, Report} from './report';

/** What a result belongs to: one model with one job, as text to be compared. */
export function keyOf(doc: Pick<Doc, 'model' | 'job'>): string {
  return JSON.stringify([doc.model?.id, doc.job]);
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
  readonly previewsPerSecond: number | null; // of the last drag
}

export const nothing: Results = {
  placed: null, check: null, preview: null, stand: null, judgement: null, busy: null, notice: null,
  previewsPerSecond: null,
};

export type ResultsStore = Signal<Results>;

/** The result of the last run, if it is of this job. */
export function freshStand(results: Results, doc: Doc): StandResult | null {
  return results.stand && results.stand.key === keyOf(doc) ? results.stand : null;
}

export function freshCheck(results: Results, doc: Doc): CheckResult | null {
  return results.check && results.check.key === keyOf(doc) ? results.check : null;
}

export function freshPreview(results: Results, doc: Pick<Doc, 'model' | 'job'>): PreviewResult | null {
  return results.preview && results.preview.key === keyOf(doc) ? results.preview : null;
}

/** The judgement to be shown: of the run that was asked for, or of the model as it came. */
export function shownJudgement(results: Results, doc: Doc): JudgementResult | null {
  const key = keyOf(doc), stand = freshStand(results, doc), asked = results.judgement?.key === key ? results.judgement : null;
  if (!stand?.outside) return asked;
  const judged = stand.report.judgement;
  return judged ? {key, of: 'result', judgement: judged} : asked?.of === 'result' ? asked : null;
}

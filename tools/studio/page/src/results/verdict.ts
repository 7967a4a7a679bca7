import type {Doc} from '../state/document';
import {bends, posesOf} from '../state/job';
import type {Figures, PoseReport, PreviewPose} from './report';
import {type Results, freshCheck, freshPreview, freshStand} from './results';
import {degrees, wayOf} from './words';

export type Tone = 'falls' | 'short' | 'stands' | 'none';

export interface Verdict {
  readonly tone: Tone;
  readonly line: string; // "Falls to the left: -7.9 degrees"
  readonly detail: string; // what was asked, what it was before
}

const unknown: Verdict = {tone: 'none', line: '', detail: ''};

/** How one pose is, of its figures. */
export function poseVerdict(pose: PoseReport, figures: Figures): Verdict {
  return pose.kind === 'hanging' ? hangingVerdict(pose, figures) : standingVerdict(pose, figures);
}

function standingVerdict(pose: PoseReport, figures: Figures): Verdict {
  const asked = pose.required_tip_deg ?? 0, tip = figures.tip_deg;
  if (tip === undefined || tip === null) return {tone: 'falls', line: 'Has nothing to stand on', detail: ''};
  const way = figures.weak_edge ? wayOf(figures.weak_edge.heading, pose.up) : '';
  return toned(tip, asked, way, way && tip >= 0 ? `weakest ${way}` : '');
}

function toned(tip: number, asked: number, way: string, weakest: string): Verdict {
  const angle = `${degrees(tip)} degrees`, detail = [weakest, `${degrees(asked)} asked`].filter(Boolean).join(', ');
  if (tip < 0) return {tone: 'falls', line: `Falls${way ? ` ${way}` : ''}: ${angle}`, detail};
  // Angles are compared as they are shown: what reads 10.0 of 10.0 asked has met it.
  if (Number(tip.toFixed(1)) < asked) return {tone: 'short', line: `Stands, but barely: ${angle}`, detail};
  return {tone: 'stands', line: `Stands: ${angle}`, detail};
}

function hangingVerdict(pose: PoseReport, figures: Figures): Verdict {
  const tilt = figures.tilt_deg ?? 180, asked = pose.required_tilt_deg ?? 0;
  return hung(tilt, asked);
}

function hung(tilt: number, asked: number): Verdict {
  const detail = `level to ${degrees(asked)} asked`;
  const level = Number(tilt.toFixed(1)) <= asked;
  return {tone: level ? 'stands' : 'falls', line: `Hangs ${level ? 'level' : 'askew'}: ${degrees(tilt)} degrees`, detail};
}

/** The figures of a pose that are true now: of the carved solid where there is one of this job. */
export function figuresOf(results: Results, doc: Doc, index: number): {pose: PoseReport; figures: Figures} | null {
  const report = (freshStand(results, doc) ?? freshCheck(results, doc))?.report;
  const pose = report?.poses[index];
  return pose ? {pose, figures: pose.after ?? pose.before} : null;
}

/** The verdict of one pose of the document as it is now; while a preview is coming, of the last that came. */
export function verdictOf(results: Results, doc: Doc, index: number, isComing = false): Verdict {
  const stand = freshStand(results, doc);
  const pose = stand?.report.poses[index];
  if (stand && pose && stand.code && !stand.outside) return inVain(poseVerdict(pose, pose.after ?? pose.before), pose);
  if (stand && pose) return ofRun(poseVerdict(pose, pose.after ?? pose.before), pose);
  const preview = !bends(doc.job) ? null : isComing ? results.preview : freshPreview(results, doc);
  const bent = preview?.preview.poses[index];
  if (preview && bent) return bentVerdict(bent, results, doc, index, preview.preview.carved_deg);
  const check = freshCheck(results, doc)?.report.poses[index];
  if (!check || bends(doc.job)) return unknown;
  const verdict = poseVerdict(check, check.before);
  return {...verdict, detail: `${verdict.detail}; as a solid`};
}

/** Nothing was written: the figures are of the best that there would be. */
function inVain(best: Verdict, pose: PoseReport): Verdict {
  const figures = pose.after ?? pose.before, angle = pose.kind === 'hanging' ? figures.tilt_deg : figures.tip_deg;
  const reach = typeof angle === 'number' ? `: ${degrees(angle)} degrees at best` : '';
  return {...ofRun(best, pose), tone: best.tone === 'falls' ? 'falls' : 'short', line: `Nothing made${reach}`};
}

function ofRun(verdict: Verdict, pose: PoseReport): Verdict {
  const before = pose.kind === 'hanging' ? pose.before.tilt_deg : pose.before.tip_deg;
  const was = pose.after && typeof before === 'number' ? `; ${degrees(before)} before` : '';
  return {...verdict, detail: verdict.detail + was};
}

function bentVerdict(bent: PreviewPose, results: Results, doc: Doc, index: number, carved: number | null): Verdict {
  const asked = posesOf(doc.job)[index];
  if (bent.tilt_deg !== undefined) return hung(bent.tilt_deg, asked?.hang?.tilt_deg ?? 2);
  const known = results.check?.report.poses[index];
  const way = known?.before.weak_edge ? wayOf(known.before.weak_edge.heading, known.up) : '';
  const verdict = toned(bent.tip_deg ?? -90, asked?.stand?.tip_deg ?? 10, way, '');
  const reach = carved === null ? '' : `; carved it could reach ${degrees(carved)}`;
  return {...verdict, detail: `as bent by hand, solid: ${verdict.detail}${reach}`};
}

/** Whether all poses of the last run hold, and how many there are. */
export function heldPoses(results: Results, doc: Doc): {held: number; all: number} | null {
  const report = (freshStand(results, doc) ?? freshCheck(results, doc))?.report;
  return report ? {held: report.poses.filter((pose) => pose.holds).length, all: report.poses.length} : null;
}

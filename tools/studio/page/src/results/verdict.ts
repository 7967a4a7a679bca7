import type {Asked} from '../state/document';
import {bends} from '../state/job';
import type {Figures, PoseReport, PreviewPose} from './report';
import {type PreviewResult, type Results, freshCheck, freshPreview, freshStand} from './results';
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
  const detail = `level to ${degrees(asked)} asked`;
  const level = Number(tilt.toFixed(1)) <= asked;
  return {tone: level ? 'stands' : 'falls', line: `Hangs ${level ? 'level' : 'askew'}: ${degrees(tilt)} degrees`, detail};
}

/** The preview that is true of what is asked; while a newer one is coming, the last that came. */
export function shownPreview(results: Results, asked: Asked, isComing: boolean): PreviewResult | null {
  if (!bends(asked.job) || freshStand(results, asked)) return null;
  return isComing ? results.preview : freshPreview(results, asked);
}

/** The poses as they are now: of what was made, of the solid as handles bend it, or of the solid as it came. */
function posesNow(results: Results, asked: Asked, isComing: boolean): readonly PoseReport[] | null {
  const stand = freshStand(results, asked);
  if (stand) return stand.report.poses;
  if (bends(asked.job)) return shownPreview(results, asked, isComing)?.preview.poses ?? null;
  return freshCheck(results, asked)?.report.poses ?? null;
}

/** A pose and the figures of it that are true now. */
export function figuresOf(results: Results, asked: Asked, index: number, isComing = false): {pose: PoseReport; figures: Figures} | null {
  const pose = posesNow(results, asked, isComing)?.[index];
  return pose ? {pose, figures: pose.after ?? pose.before} : null;
}

/** The verdict of one pose of what is asked. */
export function verdictOf(results: Results, asked: Asked, index: number, isComing = false): Verdict {
  const found = figuresOf(results, asked, index, isComing), stand = freshStand(results, asked);
  if (!found) return unknown;
  const verdict = poseVerdict(found.pose, found.figures);
  if (stand) return stand.code && !stand.outside ? inVain(verdict, found.pose) : ofRun(verdict, found.pose);
  if (bends(asked.job)) return bentVerdict(verdict, found.pose as PreviewPose);
  return {...verdict, detail: `${verdict.detail}; ${asked.profile ? 'as it would be sliced' : 'as a solid'}`};
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

function bentVerdict(verdict: Verdict, pose: PreviewPose): Verdict {
  const reach = pose.carved_deg === null ? '' : `; carved it could reach ${degrees(pose.carved_deg)}`;
  return {...verdict, detail: `as bent by hand, solid: ${verdict.detail}${reach}`};
}

/** How many poses hold as they are now, and how many there are. */
export function heldPoses(results: Results, asked: Asked, isComing = false): {held: number; all: number} | null {
  const poses = posesNow(results, asked, isComing);
  return poses && {held: poses.filter((pose) => pose.holds).length, all: poses.length};
}

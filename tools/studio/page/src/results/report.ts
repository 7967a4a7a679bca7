/** What the server reports: the parts of `--report` and of `aplomb validate --report` that the page shows. */

import type {Vec3} from '../state/job';

export interface WeakEdge {
  readonly from_mm: Vec3;
  readonly to_mm: Vec3;
  readonly heading: Vec3;
}

/** How a solid stands or hangs; which fields are there depends on the kind of pose. */
export interface Figures {
  readonly mass_g: number;
  readonly volume_mm3: number;
  readonly com_mm: Vec3;
  readonly com_height_mm?: number;
  readonly margin_mm?: number;
  readonly tip_deg?: number | null;
  readonly robust_tip_deg?: number | null;
  readonly weak_edge?: WeakEdge | null;
  readonly support_polygon_mm?: readonly Vec3[];
  readonly support_area_mm2?: number;
  readonly topple_push_n?: number;
  readonly push_height_mm?: number;
  readonly tilt_deg?: number;
  readonly drop_mm?: number;
}

export interface PoseReport {
  readonly name: string;
  readonly kind: 'standing' | 'hanging';
  readonly up: Vec3;
  readonly required_tip_deg?: number;
  readonly required_tilt_deg?: number;
  readonly attachments_mm?: readonly Vec3[];
  readonly holds: boolean;
  readonly before: Figures;
  readonly after?: Figures | null;
}

export interface Check {
  readonly id: string;
  readonly verdict: string;
  readonly measured?: number;
  readonly threshold?: number;
  readonly unit?: string;
}

export interface Finding {
  readonly id: string;
  readonly severity: 'info' | 'warn' | 'fail';
  readonly at_mm?: Vec3;
  readonly box_mm?: readonly [Vec3, Vec3];
  readonly text: string;
  readonly remedy?: string;
}

export interface Judgement {
  readonly process: string;
  readonly passes: boolean;
  readonly new_failures?: readonly string[]; // of a result: those that the model as it came does not have
  readonly checks: readonly Check[];
  readonly findings: readonly Finding[];
}

export interface Report {
  readonly outcome: string;
  readonly poses: readonly PoseReport[];
  readonly carving?: {readonly void_mm3?: number; readonly bound_deg?: number; readonly aim?: string} | null;
  readonly deformation?: {readonly mean_mm?: number; readonly max_mm?: number} | null;
  readonly wall_mm?: {readonly required: number; readonly measured?: number | null};
  readonly judgement?: Judgement | null;
  readonly hints?: readonly string[];
}

/** `before`: of the bent solid, uncarved. */
export interface PreviewPose extends PoseReport {
  readonly carved_deg: number | null; // with the best void for all poses
}

export interface Preview {
  readonly wish: number;
  readonly settled: boolean;
  readonly mean_mm: number;
  readonly max_mm: number;
  readonly handle_short_mm: number;
  readonly poses: readonly PreviewPose[];
}

export interface Placed {
  readonly triangles: number;
  readonly box_mm: readonly [Vec3, Vec3];
  readonly volume_mm3: number;
  readonly center_mm: Vec3;
  readonly from_file: readonly number[];
  readonly notes: readonly string[];
}

import type {Sent} from './state/document';
import type {Job} from './state/job';

/** What the server says of itself when the page begins. */
export interface Start {
  readonly version: string | number;
  readonly model: Sent | null;
  readonly profile: Sent | null;
  readonly job: (Job & {readonly aplomb_job?: number}) | null;
  readonly fixtures: readonly {readonly name: string}[];
  readonly limits: {readonly upload_bytes: number; readonly max_triangles: number};
  readonly materials: readonly string[];
  readonly processes: readonly {readonly name: string; readonly wall_mm: number}[];
}

import type {Model} from './state/document';
import type {Job} from './state/job';

/** What the server says of itself when the page begins. */
export interface Start {
  readonly version: string | number;
  readonly model: Model | null;
  readonly job: (Job & {readonly aplomb_job?: number}) | null;
  readonly fixtures: readonly {readonly name: string}[];
  readonly limits: {readonly upload_bytes: number; readonly max_triangles: number};
  readonly materials: readonly string[];
  readonly processes: readonly {readonly name: string; readonly wall_mm: number}[];
}

/** A job as it is asked for: its version is the server's to write. */
export function withoutVersion(job: Start['job']): Job {
  const {aplomb_job: _, ...rest} = job ?? {};
  return rest;
}

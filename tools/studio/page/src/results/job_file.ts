import type {Job} from '../state/job';

type JobFile = Readonly<Record<string, unknown>>;

const mostBytes = 1_000_000; // what a request may have
const ofFiles = ['aplomb_job', 'model', 'output', 'report', 'dump', 'html', 'picture', 'plugs', 'profile', 'modifier'];

/** The job that a file holds as text; null where it is none, such as a slicer's settings. */
export function jobOf(text: string): JobFile | null {
  try {
    const read = JSON.parse(text) as unknown;
    return read !== null && typeof read === 'object' && 'aplomb_job' in read ? (read as JobFile) : null;
  } catch {
    return null;
  }
}

export async function jobIn(file: File): Promise<JobFile | null> {
  return /\.json$/i.test(file.name) && file.size <= mostBytes ? jobOf(await file.text()) : null;
}

/** A job as the server is asked about it: it names no files, and its version is the server's to write. */
export function withoutFiles(file: JobFile): Job {
  return Object.fromEntries(Object.entries(file).filter(([key]) => !ofFiles.includes(key)));
}

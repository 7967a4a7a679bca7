import type {DocumentStore, Sent} from '../state/document';
import {type Job, edited, emptyJob} from '../state/job';
import type {Client} from '../transport/client';
import {jobIn, withoutFiles} from './job_file';
import type {Placer} from './placer';
import type {Busy, ResultsStore} from './results';

/** Opens what is dropped, chosen or given at the start. The server reads it first: what it cannot read changes nothing. */
export class Opening {
  #reading: AbortController | null = null;

  constructor(private readonly client: Client, private readonly documents: DocumentStore, private readonly results: ResultsStore,
              private readonly placer: Placer, private readonly mostBytes: number,
              private readonly begins: () => void, private readonly failed: (error: unknown) => void) {}

  /** A model, a job, or a slicer's profile, by its name and what is in it. */
  async take(file: File): Promise<void> {
    if (!/\.(ini|gcode|gco|g|cfg|json)$/i.test(file.name)) return this.#model(file.name, (signal) => this.#upload('model', file, signal));
    const job = await jobIn(file).catch(() => null); // what cannot be read is told of when it is sent
    if (!this.documents.doc.model) {
      const what = job ? 'is a job' : 'says how a model is sliced';
      return this.failed(new Error(`${file.name} ${what}: open the model first`));
    }
    return job ? this.#job(file.name, job) : this.#profile(file);
  }

  fixture(name: string): Promise<void> {
    return this.#model(name, (signal) => this.client.json<Sent>('/api/fixture', {name}, signal));
  }

  /** What the server was started with. */
  begin(model: Sent, job: Job, profile: Sent | null): Promise<void> {
    return this.#read('read', model.name, (signal) => this.#open(model, job, profile, signal));
  }

  /** Leaves open what is open. */
  cancel(): void {
    if (this.results.value.busy?.what === 'open') this.#reading?.abort();
  }

  #model(name: string, send: (signal: AbortSignal) => Promise<Sent>): Promise<void> {
    return this.#read('open', name, async (signal) => this.#open(await send(signal), emptyJob, null, signal));
  }

  async #open(model: Sent, job: Job, profile: Sent | null, signal: AbortSignal): Promise<void> {
    await this.placer.place({model, profile, job}, signal);
    this.documents.open(model, job, profile);
  }

  /** A slicer's profile: what is open is reckoned as it will be sliced. */
  #profile(file: File): Promise<void> {
    return this.#read('open', file.name, async (signal) => this.documents.slice(await this.#upload('profile', file, signal)));
  }

  /** A job for the model that is open: the files that it names stay away. */
  #job(name: string, file: Readonly<Record<string, unknown>>): Promise<void> {
    if (file.aplomb_job !== 1) return Promise.resolve(this.failed(new Error(`${name} is a job of another version than 1`)));
    return this.#read('open', name, async (signal) => {
      const {doc} = this.documents, job = edited(withoutFiles(file), doc.profile ? {} : {ballast: undefined});
      await this.placer.placeAnew({...doc, job}, signal);
      this.documents.adopt(job);
      const sentences = [notFor(file, doc.model?.name), doc.profile ? '' : wantsProfile(file)].filter(Boolean);
      if (sentences.length) this.results.patch({notice: {tone: 'note', sentence: sentences.join(' ')}});
    });
  }

  /** A file that is too large is not sent at all: the server would hang up on it. */
  async #upload(kind: 'model' | 'profile', file: File, signal: AbortSignal): Promise<Sent> {
    const most = Math.floor(this.mostBytes / 2 ** 20);
    if (file.size > this.mostBytes) throw new Error(`a file may have up to ${most} MB here`);
    return this.client.upload<Sent>(kind, file.name, file, signal);
  }

  /** One at a time: a newer one ends the one before. */
  async #read(what: Busy['what'], name: string, work: (signal: AbortSignal) => Promise<void>): Promise<void> {
    this.#reading?.abort();
    this.begins();
    const reading = (this.#reading = new AbortController());
    this.results.patch({busy: {what, fraction: null, stage: `Reading ${name}`}, notice: null});
    try {
      await work(reading.signal);
    } catch (error) {
      this.failed(error);
    } finally {
      if (this.#reading === reading) {
        this.#reading = null;
        if (this.results.value.busy?.what === what) this.results.patch({busy: null});
      }
    }
  }
}

const nameIn = (path: unknown) => (typeof path === 'string' ? path.split(/[\\/]/).at(-1)! : '');

function notFor(file: Readonly<Record<string, unknown>>, open: string | undefined): string {
  const name = nameIn(file.model);
  return name && name !== open ? `The job was made for ${name}; it is now asked of ${open}.` : '';
}

function wantsProfile(file: Readonly<Record<string, unknown>>): string {
  const name = nameIn(file.profile);
  return name ? `It goes with the profile ${name}, which is to be chosen under Slicing.` : '';
}

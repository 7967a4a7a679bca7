import type {DocumentStore} from '../state/document';
import {type Client, isAbort} from '../transport/client';
import type {MeshData} from '../transport/frames';
import {goesOn} from './messages';
import type {Judgement, Report} from './report';
import {type Busy, type ResultsStore, type StandResult, bodyOf, keyOf} from './results';

/** The two that take their time: making it stand, and judging how it prints. One at a time. */
export class Runs {
  #running: AbortController | null = null;

  constructor(private readonly client: Client, private readonly documents: DocumentStore,
              private readonly results: ResultsStore, private readonly failed: (error: unknown) => void,
              private readonly ended: () => void) {}

  get busy(): boolean {
    return this.#running !== null;
  }

  cancel(): void {
    this.#running?.abort();
  }

  stand(): Promise<void> {
    return this.#run('stand', 'Beginning', (signal) => this.#stand(signal));
  }

  validate(of: 'model' | 'result'): Promise<void> {
    return this.#run('validate', 'Judging', (signal) => this.#validate(of, signal));
  }

  async #run(what: Busy['what'], stage: string, work: (signal: AbortSignal) => Promise<void>): Promise<void> {
    if (!this.documents.doc.model || this.#running) return;
    const running = new AbortController();
    this.#running = running;
    this.results.patch({busy: {what, fraction: 0, stage}, notice: null});
    try {
      await work(running.signal);
    } catch (error) {
      if (!isAbort(error)) this.failed(error);
    } finally {
      this.#running = null;
      if (this.results.value.busy?.what === what) this.results.patch({busy: null});
      this.ended();
    }
  }

  #progress(what: Busy['what'], message: {readonly [key: string]: unknown}, signal: AbortSignal): void {
    if (!signal.aborted) this.results.patch({busy: {what, fraction: Number(message.fraction), stage: String(message.stage)}});
  }

  /** What is known is shown as it comes: the report first, the surfaces after it. */
  async #stand(signal: AbortSignal): Promise<void> {
    const doc = this.documents.doc;
    let made: StandResult | null = null;
    for await (const frame of this.client.stream('/api/stand', bodyOf(doc), signal)) {
      if (frame.kind === 'mesh' && made) made = withSurface(made, frame.mesh);
      if (frame.kind === 'json') {
        const {message} = frame;
        if (!goesOn(message)) return;
        if (message.type === 'report') made = begun(keyOf(doc), message.report as Report, String(message.message));
        if (message.type === 'written' && made) made = {...made, isWritten: true};
        if (message.type === 'ended' && made) made = {...made, code: Number(message.code)};
        if (made && (message.type === 'progress' || message.type === 'written')) this.results.patch({stand: made});
        if (message.type === 'progress') this.#progress('stand', message, signal);
        if (message.type === 'ended' && Number(message.code) !== 0)
          this.results.patch({notice: {tone: 'error', sentence: String(message.message)}});
      }
    }
    if (made) this.results.patch({stand: made});
  }

  async #validate(of: 'model' | 'result', signal: AbortSignal): Promise<void> {
    const doc = this.documents.doc;
    for await (const frame of this.client.stream('/api/validate', {...bodyOf(doc), of}, signal)) {
      if (frame.kind !== 'json') continue;
      if (!goesOn(frame.message)) return;
      if (frame.message.type === 'progress') this.#progress('validate', frame.message, signal);
      if (frame.message.type === 'judgement')
        this.results.patch({judgement: {key: keyOf(doc), of, judgement: frame.message.judgement as Judgement}});
    }
  }
}

function begun(key: string, report: Report, message: string): StandResult {
  return {key, report, message, outside: null, voids: [], dense: null, isWritten: false, code: null};
}

function withSurface(made: StandResult, mesh: MeshData): StandResult {
  if (mesh.name === 'void') return {...made, voids: [...made.voids, mesh]};
  if (mesh.name === 'dense') return {...made, dense: mesh};
  return {...made, outside: made.outside ? joined(made.outside, mesh) : mesh};
}

/** Two surfaces as one. */
function joined(a: MeshData, b: MeshData): MeshData {
  const shift = a.positions.length / 3;
  const positions = new Float32Array(a.positions.length + b.positions.length);
  positions.set(a.positions);
  positions.set(b.positions, a.positions.length);
  const triangles = new Uint32Array(a.triangles.length + b.triangles.length);
  triangles.set(a.triangles);
  triangles.set(b.triangles.map((vertex) => vertex + shift), a.triangles.length);
  return {name: a.name, positions, triangles};
}

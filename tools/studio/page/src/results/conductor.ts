import {carried, matrixOf} from '../state/placement';
import type {Doc, DocumentStore, Model} from '../state/document';
import {type Job, bends, placeKey} from '../state/job';
import {type Client, Refusal, isAbort} from '../transport/client';
import type {Frame} from '../transport/frames';
import {Newest, type Turn} from '../transport/newest';
import type {Placed, Report} from './report';
import {PreviewFlow} from './preview_flow';
import {type ResultsStore, freshStand, keyOf, nothing} from './results';
import {Runs} from './runs';

type Message = Extract<Frame, {kind: 'json'}>['message'];

/** Throws what a message says went wrong. \return whether the stream goes on. */
export function goesOn(message: Message): boolean {
  if (message.type === 'error') throw new Refusal(String(message.message), 0, Number(message.code));
  return message.type !== 'cancelled';
}

/** Asks the server for whatever the document needs to be shown as it is now. */
export class Conductor {
  readonly runs: Runs;
  readonly previews: PreviewFlow;
  readonly #quick: Newest<Doc>;
  readonly #matrices = new Map<string, readonly number[]>(); // from the file, by model and placement

  constructor(private readonly client: Client, private readonly documents: DocumentStore,
              private readonly results: ResultsStore, private readonly mostBytes: number) {
    const failed = (error: unknown) => this.fail(error);
    this.#quick = new Newest<Doc>((doc, turn) => this.#see(doc, turn), failed);
    this.runs = new Runs(client, documents, results, failed);
    this.previews = new PreviewFlow(client, documents, results, failed);
    documents.state.subscribe((state, before) => {
      if (state.history !== before.history) this.#changed(before.history.present.value);
      else if (state.wish && state.wish !== before.wish) this.#wished();
      else if (!state.wish && before.wish) this.previews.ask(); // dropped: back to what is
    });
  }

  /** Says a sentence of the server, or of the page, where it is seen and heard. */
  fail(error: unknown): void {
    if (isAbort(error)) return;
    const sentence = error instanceof Error ? error.message : String(error);
    this.results.patch({notice: {tone: 'error', sentence}, busy: null});
  }

  async openFile(file: File): Promise<void> {
    await this.#open(`Reading ${file.name}`, () => this.#upload(file));
  }

  /** A file that is too large is not sent at all: the server would hang up on it. */
  async #upload(file: File): Promise<Model> {
    const most = Math.floor(this.mostBytes / 2 ** 20);
    if (file.size > this.mostBytes) throw new Error(`a file may have up to ${most} MB here`);
    return this.client.upload<Model>(file.name, file);
  }

  async openFixture(name: string): Promise<void> {
    await this.#open(`Reading ${name}`, () => this.client.json<Model>('/api/fixture', {name}));
  }

  async #open(stage: string, ask: () => Promise<Model>, job?: Job): Promise<void> {
    this.results.patch({busy: {what: 'open', fraction: null, stage}, notice: null});
    try {
      const model = await ask();
      this.documents.open(model, job);
    } catch (error) {
      this.fail(error);
    }
  }

  /** Asks again for what is missing, as after the solver died. */
  again(): void {
    this.results.patch({notice: null});
    this.#quick.ask(this.documents.doc);
  }

  async cancel(): Promise<void> {
    this.runs.cancel();
    await this.client.json('/api/cancel', {}).catch((error: unknown) => this.fail(error));
  }

  /** A hand drags: what runs is of another job, and would make the previews wait. */
  #wished(): void {
    this.runs.cancel();
    this.previews.ask();
  }

  #changed(before: Doc): void {
    const doc = this.documents.doc;
    if (!doc.model) return;
    if (doc.model.id !== before.model?.id) this.results.set({...nothing, busy: this.results.value.busy});
    if (keyOf(doc) !== keyOf(before)) this.runs.cancel();
    if (this.results.value.notice) this.results.patch({notice: null});
    this.#quick.ask(doc);
  }

  /** Places the model where that is new, carries points along, checks, and bends by the handles. */
  async #see(doc: Doc, turn: Turn): Promise<void> {
    turn.served();
    const place = this.#placeKey(doc);
    if (this.results.value.placed?.key !== place) await this.#place(doc, place, turn);
    if (turn.signal.aborted) return;
    if (doc.frame !== placeKey(doc.job)) return this.#carry(doc);
    if (!freshStand(this.results.value, doc) && this.results.value.check?.key !== keyOf(doc)) await this.#check(doc, turn);
    if (!turn.signal.aborted && bends(doc.job)) this.previews.ask();
  }

  #placeKey(doc: Doc): string {
    return JSON.stringify([doc.model?.id, placeKey(doc.job)]);
  }

  async #place(doc: Doc, key: string, turn: Turn): Promise<void> {
    const stage = this.results.value.placed ? 'Placing' : `Reading ${doc.model?.name ?? ''}`;
    this.results.patch({busy: this.results.value.busy ?? {what: 'read', fraction: null, stage}});
    try {
      let placed: Placed | null = null;
      for await (const frame of this.client.stream('/api/place', {model: doc.model?.id, job: doc.job}, turn.signal)) {
        if (frame.kind === 'json' && goesOn(frame.message) && frame.message.type === 'placed')
          placed = frame.message as unknown as Placed;
        if (frame.kind !== 'mesh' || !placed) continue;
        this.#matrices.set(key, placed.from_file);
        this.results.patch({placed: {key, placed, mesh: frame.mesh}, preview: null});
      }
    } finally {
      const busy = this.results.value.busy;
      if (busy?.what === 'read' || busy?.what === 'open') this.results.patch({busy: null});
    }
  }

  /** The document's points are of another placement: the same step, said in this one. */
  #carry(doc: Doc): void {
    const before = this.#matrices.get(JSON.stringify([doc.model?.id, doc.frame]));
    const now = this.#matrices.get(this.#placeKey(doc));
    if (!now || doc !== this.documents.doc) return;
    const change = before && matrixOf(now).multiply(matrixOf(before).invert());
    this.documents.amend(change ? carried(doc.job, change) : doc.job, placeKey(doc.job));
  }

  async #check(doc: Doc, turn: Turn): Promise<void> {
    for await (const frame of this.client.stream('/api/check', {model: doc.model?.id, job: doc.job}, turn.signal)) {
      if (frame.kind !== 'json' || !goesOn(frame.message) || frame.message.type !== 'report') continue;
      const report = frame.message.report as Report;
      this.results.patch({check: {key: keyOf(doc), report, message: String(frame.message.message)}});
    }
  }
}

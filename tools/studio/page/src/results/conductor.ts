import {carried, matrixOf} from '../state/placement';
import type {Asked, Doc, DocumentStore} from '../state/document';
import {bends, placeKey} from '../state/job';
import {type Client, isAbort} from '../transport/client';
import {Newest, type Turn} from '../transport/newest';
import {goesOn, insist} from './messages';
import {Opening} from './opening';
import {Placer, placedKey} from './placer';
import {PreviewFlow} from './preview_flow';
import type {Report} from './report';
import {type ResultsStore, bodyOf, freshStand, keyOf, nothing} from './results';
import {Runs} from './runs';

/** Asks the server for whatever the document needs to be shown as it is now. */
export class Conductor {
  readonly runs: Runs;
  readonly previews: PreviewFlow;
  readonly opening: Opening;
  readonly #quick: Newest<Doc>;
  readonly #placer: Placer;

  constructor(private readonly client: Client, private readonly documents: DocumentStore,
              private readonly results: ResultsStore, mostBytes: number) {
    const failed = (error: unknown) => this.fail(error);
    const unanswered = (error: unknown, asked: Asked) => {
      this.results.patch({failed: keyOf(asked)});
      this.fail(error);
    };
    this.#placer = new Placer(client);
    this.#quick = new Newest<Doc>((doc, turn) => this.#see(doc, turn), unanswered);
    this.runs = new Runs(client, documents, results, failed, () => this.#fill());
    this.previews = new PreviewFlow(client, documents, results, this.runs, unanswered);
    this.opening = new Opening(client, documents, results, this.#placer, mostBytes, () => this.runs.cancel(), failed);
    documents.state.subscribe((state, before) => {
      if (state.history !== before.history) this.#changed(before.history.present.value);
      else if (state.wish && state.wish !== before.wish) this.#wished();
      else if (!state.wish && before.wish) this.previews.ask(); // dropped: back to what is
    });
  }

  /** Whether what is asked is still being answered: until then the last preview holds. */
  get answering(): boolean {
    return this.#quick.busy || this.previews.busy;
  }

  /** Says a sentence of the server, or of the page, where it is seen and heard. */
  fail(error: unknown): void {
    if (isAbort(error)) return;
    const sentence = error instanceof Error ? error.message : String(error);
    this.results.patch({notice: {tone: 'error', sentence}});
  }

  /** Asks again for what is missing, as after the solver died. */
  again(): void {
    this.results.patch({notice: null});
    this.#quick.ask(this.documents.doc);
  }

  /** Ends what takes long, and nothing of what the verdict needs. The server notices that nobody listens any more. */
  cancel(): void {
    this.runs.cancel();
    this.opening.cancel();
  }

  /** A run kept the server from answering, and may have come to nothing. */
  #fill(): void {
    if (this.documents.doc.model && !this.#quick.busy) this.#quick.ask(this.documents.doc);
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
    if (this.results.value.failed !== null) this.results.patch({failed: null});
    if (this.results.value.placed?.key !== placedKey(doc)) await this.#place(doc, turn);
    if (turn.signal.aborted) return;
    if (doc.frame !== placeKey(doc.job)) return this.#carry(doc);
    if (!freshStand(this.results.value, doc) && this.results.value.check?.key !== keyOf(doc))
      await insist(() => this.#check(doc, turn), turn.signal);
    if (!turn.signal.aborted && bends(doc.job)) this.previews.ask();
  }

  async #place(doc: Doc, turn: Turn): Promise<void> {
    const stage = this.results.value.placed ? 'Placing' : `Reading ${doc.model?.name ?? ''}`;
    this.results.patch({busy: this.results.value.busy ?? {what: 'read', fraction: null, stage}});
    try {
      const placed = await this.#placer.place(doc, turn.signal);
      this.results.patch({placed, preview: null});
    } finally {
      if (this.results.value.busy?.what === 'read') this.results.patch({busy: null});
    }
  }

  /** The document's points are of another placement: the same step, said in this one. */
  #carry(doc: Doc): void {
    const before = this.#placer.fromFile(doc.model?.id, doc.frame), now = this.#placer.fromFile(doc.model?.id, placeKey(doc.job));
    if (!now || doc !== this.documents.doc) return;
    const change = before && matrixOf(now).multiply(matrixOf(before).invert());
    this.documents.amend(change ? carried(doc.job, change) : doc.job, placeKey(doc.job));
  }

  /** \return whether there was an answer. */
  async #check(doc: Doc, turn: Turn): Promise<boolean> {
    for await (const frame of this.client.stream('/api/check', bodyOf(doc), turn.signal)) {
      if (frame.kind !== 'json' || !goesOn(frame.message) || frame.message.type !== 'report') continue;
      const report = frame.message.report as Report;
      this.results.patch({check: {key: keyOf(doc), report, message: String(frame.message.message)}});
      return true;
    }
    return false;
  }
}

import type {DocumentStore} from '../state/document';
import {type Job, bends} from '../state/job';
import type {Client} from '../transport/client';
import {Newest, type Turn} from '../transport/newest';
import {goesOn} from './conductor';
import type {Preview} from './report';
import {type ResultsStore, keyOf} from './results';

interface Wish {
  readonly model: number;
  readonly job: Job;
  readonly number: number;
}

/** What the handles do to the model, asked for again with every move of the hand; the newest wish wins. */
export class PreviewFlow {
  readonly #newest: Newest<Wish>;
  #number = 0;
  #arrivals: number[] = []; // milliseconds of the previews of this drag

  constructor(private readonly client: Client, private readonly documents: DocumentStore,
              private readonly results: ResultsStore, failed: (error: unknown) => void) {
    this.#newest = new Newest<Wish>((wish, turn) => this.#follow(wish, turn), failed);
  }

  /** Whether an answer is on its way. */
  get busy(): boolean {
    return this.#newest.busy;
  }

  /** A hand takes hold: previews are counted from here on. */
  begin(): void {
    this.#arrivals = [];
    performance.clearMarks('aplomb-wish');
    performance.clearMarks('aplomb-preview-drawn');
  }

  ask(): void {
    const model = this.documents.doc.model, job = this.documents.job;
    if (!model) return;
    if (bends(job)) {
      performance.mark('aplomb-wish', {detail: ++this.#number});
      this.#newest.ask({model: model.id, job, number: this.#number});
    } else {
      this.#newest.cancel();
      this.results.patch({preview: null});
    }
  }

  async #follow(wish: Wish, turn: Turn): Promise<void> {
    const body = {model: wish.model, job: wish.job, wish: wish.number};
    const key = keyOf({model: this.documents.doc.model, job: wish.job});
    if (this.results.value.preview?.key === key && this.results.value.preview.preview.settled) return;
    let preview: Preview | null = null;
    for await (const frame of this.client.stream('/api/preview', body, turn.signal)) {
      if (frame.kind === 'json' && goesOn(frame.message) && frame.message.type === 'preview')
        preview = frame.message as unknown as Preview;
      if (frame.kind !== 'positions' || !preview) continue;
      this.results.patch({preview: {key, preview, positions: frame.positions}, ...this.#rate()});
      turn.served();
    }
  }

  #rate(): {previewsPerSecond?: number} {
    const arrivals = this.#arrivals;
    arrivals.push(performance.now());
    const first = arrivals[0] as number, last = arrivals.at(-1) as number;
    return last > first ? {previewsPerSecond: (1000 * (arrivals.length - 1)) / (last - first)} : {};
  }
}

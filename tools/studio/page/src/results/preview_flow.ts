import type {Asked, DocumentStore} from '../state/document';
import {bends} from '../state/job';
import type {Client} from '../transport/client';
import {Newest, type Turn} from '../transport/newest';
import {goesOn, insist} from './messages';
import type {Preview} from './report';
import {type ResultsStore, bodyOf, keyOf} from './results';

interface Wish {
  readonly asked: Asked;
  readonly number: number;
}

/** What the handles do to the model, asked for again with every move of the hand; the newest wish wins. */
export class PreviewFlow {
  readonly #newest: Newest<Wish>;
  #number = 0;
  #count = 0; // previews of this drag
  #awaited_ms = 0; // how long they were waited for

  constructor(private readonly client: Client, private readonly documents: DocumentStore,
              private readonly results: ResultsStore, private readonly runs: {readonly busy: boolean},
              failed: (error: unknown, asked: Asked) => void) {
    this.#newest = new Newest<Wish>((wish, turn) => this.#follow(wish, turn), (error, wish) => failed(error, wish.asked));
  }

  /** Whether an answer is on its way. */
  get busy(): boolean {
    return this.#newest.busy;
  }

  /** A hand takes hold: previews are counted from here on. */
  begin(): void {
    this.#count = this.#awaited_ms = 0;
    performance.clearMarks('aplomb-wish');
    performance.clearMarks('aplomb-preview-drawn');
  }

  ask(): void {
    const {asked} = this.documents;
    if (!asked.model) return;
    if (bends(asked.job)) {
      performance.mark('aplomb-wish', {detail: ++this.#number});
      this.#newest.ask({asked, number: this.#number});
    } else {
      this.#newest.cancel();
      this.results.patch({preview: null});
    }
  }

  async #follow(wish: Wish, turn: Turn): Promise<void> {
    const key = keyOf(wish.asked);
    if (this.results.value.preview?.key === key && this.results.value.preview.preview.settled) return;
    // A run has the solver for itself: who waits for its end asks then.
    await insist(async () => (await this.#answer(wish, key, turn)) || this.runs.busy, turn.signal);
  }

  /** \return whether there was an answer. */
  async #answer(wish: Wish, key: string, turn: Turn): Promise<boolean> {
    let preview: Preview | null = null, since = performance.now(), isAnswered = false;
    for await (const frame of this.client.stream('/api/preview', {...bodyOf(wish.asked), wish: wish.number}, turn.signal)) {
      if (frame.kind === 'json' && goesOn(frame.message) && frame.message.type === 'preview')
        preview = frame.message as unknown as Preview;
      if (frame.kind !== 'positions' || !preview) continue;
      const now = performance.now();
      if (this.documents.state.value.wish) this.#rate(now - since);
      this.results.patch({preview: {key, preview, positions: frame.positions}});
      since = now;
      isAnswered = true;
      turn.served();
    }
    return isAnswered;
  }

  /** Previews a second of waiting for them: a hand that stays where it is asks for none. */
  #rate(waited_ms: number): void {
    this.#awaited_ms += waited_ms;
    this.results.patch({previewsPerSecond: (1000 * ++this.#count) / Math.max(1, this.#awaited_ms)});
  }
}

import type {Asked} from '../state/document';
import {placeKey} from '../state/job';
import type {Client} from '../transport/client';
import {goesOn, insist} from './messages';
import type {Placed} from './report';
import {type PlacedResult, bodyOf} from './results';

/** What a placed model belongs to: one model in one placement. */
export function placedKey({model, job}: Asked): string {
  return keyIn(model?.id, placeKey(job));
}

function keyIn(model: number | undefined, placement: string): string {
  return JSON.stringify([model, placement]);
}

/** Has models put on the plate, and knows how each of their placements came of the file. */
export class Placer {
  readonly #matrices = new Map<string, readonly number[]>(); // from the file
  #last: PlacedResult | null = null;

  constructor(private readonly client: Client) {}

  /** The last one is at hand: what is to be opened is placed before. */
  place(asked: Asked, signal: AbortSignal): Promise<PlacedResult> {
    return this.#last?.key === placedKey(asked) ? Promise.resolve(this.#last) : this.placeAnew(asked, signal);
  }

  /** Asks the server in any case: it reads all of the job. */
  async placeAnew(asked: Asked, signal: AbortSignal): Promise<PlacedResult> {
    const key = placedKey(asked);
    let found: PlacedResult | null = null;
    await insist(async () => {
      found = await this.#ask(asked, key, signal);
      return found !== null;
    }, signal);
    signal.throwIfAborted();
    const result = found as unknown as PlacedResult;
    this.#matrices.set(key, result.placed.from_file);
    return (this.#last = result);
  }

  async #ask(asked: Asked, key: string, signal: AbortSignal): Promise<PlacedResult | null> {
    let placed: Placed | null = null;
    for await (const frame of this.client.stream('/api/place', bodyOf(asked), signal)) {
      if (frame.kind === 'json' && goesOn(frame.message) && frame.message.type === 'placed')
        placed = frame.message as unknown as Placed;
      if (frame.kind === 'mesh' && placed) return {key, placed, mesh: frame.mesh};
    }
    return null;
  }

  /** Rows of the 3 x 4 matrix from the file, once a model was placed so. */
  fromFile(model: number | undefined, placement: string): readonly number[] | undefined {
    return this.#matrices.get(keyIn(model, placement));
  }
}

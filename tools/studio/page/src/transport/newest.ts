import {isAbort} from './client';

export interface Turn {
  readonly signal: AbortSignal;
  /** From now on a newer wish may end this one. */
  served(): void;
}

/**
 * Does one thing at a time and, of all that is wished meanwhile, only the newest.
 *
 * A wish is ended by a newer one once it is served, so that a hand that never rests still gets answers.
 */
export class Newest<T> {
  #waiting: {value: T} | null = null;
  #running: {abort: AbortController; served: boolean} | null = null;

  constructor(private readonly work: (value: T, turn: Turn) => Promise<void>,
              private readonly failed: (error: unknown, value: T) => void) {}

  get busy(): boolean {
    return this.#running !== null;
  }

  ask(value: T): void {
    this.#waiting = {value};
    if (!this.#running) void this.#run();
    else if (this.#running.served) this.#running.abort.abort();
  }

  /** Ends what runs, and forgets what waits. */
  cancel(): void {
    this.#waiting = null;
    this.#running?.abort.abort();
  }

  async #run(): Promise<void> {
    while (this.#waiting) {
      const {value} = this.#waiting;
      this.#waiting = null;
      const running = {abort: new AbortController(), served: false};
      this.#running = running;
      const served = () => {
        running.served = true;
        if (this.#waiting) running.abort.abort();
      };
      try {
        await this.work(value, {signal: running.abort.signal, served});
      } catch (error) {
        if (!isAbort(error)) this.failed(error, value);
      }
      this.#running = null;
    }
  }
}

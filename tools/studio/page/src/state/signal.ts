/** A value that tells who asked when another is set. */
export class Signal<T> {
  #value: T;
  readonly #listeners = new Set<(value: T, before: T) => void>();

  constructor(value: T) {
    this.#value = value;
  }

  get value(): T {
    return this.#value;
  }

  set(value: T): void {
    if (Object.is(value, this.#value)) return;
    const before = this.#value;
    this.#value = value;
    for (const listener of [...this.#listeners]) listener(value, before);
  }

  /** Changes some fields of a value that is an object. */
  patch(fields: Partial<T>): void {
    this.set({...this.#value, ...fields});
  }

  /** Calls back after each change; the answer stops that. */
  subscribe(listener: (value: T, before: T) => void): () => void {
    this.#listeners.add(listener);
    return () => this.#listeners.delete(listener);
  }

  /** As subscribe, and once now. */
  watch(listener: (value: T, before: T) => void): () => void {
    listener(this.#value, this.#value);
    return this.subscribe(listener);
  }
}

/** Values that were, the one that is, and those that were taken back. Immutable: each step makes another. */
export interface History<T> {
  readonly past: readonly Step<T>[];
  readonly present: Step<T>;
  readonly future: readonly Step<T>[];
}

export interface Step<T> {
  readonly value: T;
  readonly label: string; // what was done to come here, such as "wall"
}

export const mostSteps = 500;

export function started<T>(value: T): History<T> {
  return {past: [], present: {value, label: ''}, future: []};
}

export function done<T>(history: History<T>, value: T, label: string): History<T> {
  return {past: [...history.past, history.present].slice(-mostSteps), present: {value, label}, future: []};
}

/** The present said otherwise: no step of its own. */
export function amended<T>(history: History<T>, value: T): History<T> {
  return {...history, present: {...history.present, value}};
}

export function undone<T>(history: History<T>): History<T> {
  const last = history.past.at(-1);
  if (!last) return history;
  return {past: history.past.slice(0, -1), present: last, future: [history.present, ...history.future]};
}

export function redone<T>(history: History<T>): History<T> {
  const next = history.future[0];
  if (!next) return history;
  return {past: [...history.past, history.present], present: next, future: history.future.slice(1)};
}

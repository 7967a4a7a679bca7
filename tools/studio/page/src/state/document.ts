import {type History, amended, done, redone, started, undone} from './history';
import {type Job, emptyJob, placeKey} from './job';
import {Signal} from './signal';

export interface Model {
  readonly id: number;
  readonly name: string;
  readonly bytes: number;
}

/** What is edited. Its points are in the coordinates of the placement `frame`. */
export interface Doc {
  readonly model: Model | null;
  readonly job: Job;
  readonly frame: string;
}

export interface DocumentState {
  readonly history: History<Doc>;
  readonly wish: Job | null; // the job while a hand drags something
}

/** The one document, its undo and redo, and the wish of a hand that has not come to rest. */
export class DocumentStore {
  readonly state = new Signal<DocumentState>({
    history: started<Doc>({model: null, job: emptyJob, frame: placeKey(emptyJob)}), wish: null,
  });

  get doc(): Doc {
    return this.state.value.history.present.value;
  }

  /** The job as it is shown: the wish where there is one. */
  get job(): Job {
    return this.state.value.wish ?? this.doc.job;
  }

  open(model: Model, job: Job = emptyJob): void {
    this.#set(done(this.state.value.history, {model, job, frame: placeKey(job)}, 'open'));
  }

  change(job: Job, label: string): void {
    if (JSON.stringify(job) === JSON.stringify(this.doc.job)) {
      this.state.patch({wish: null});
      return;
    }
    this.#set(done(this.state.value.history, {...this.doc, job}, label));
  }

  /** Shows a job without a step of its own, until change() or drop(). */
  hold(job: Job): void {
    this.state.patch({wish: job});
  }

  drop(): void {
    this.state.patch({wish: null});
  }

  /** Says the present otherwise, as when points are carried along to another placement. */
  amend(job: Job, frame: string): void {
    this.#set(amended(this.state.value.history, {...this.doc, job, frame}));
  }

  undo(): void {
    if (this.canUndo) this.#set(undone(this.state.value.history));
  }

  redo(): void {
    this.#set(redone(this.state.value.history));
  }

  /** The first step opened the model: before it there is nothing to go back to. */
  get canUndo(): boolean {
    return this.state.value.history.past.at(-1)?.value.model != null;
  }

  get canRedo(): boolean {
    return this.state.value.history.future.length > 0;
  }

  #set(history: History<Doc>): void {
    this.state.set({history, wish: null});
  }
}

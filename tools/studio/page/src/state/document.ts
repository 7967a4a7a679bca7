import {type History, amended, done, redone, started, undone} from './history';
import {type Job, edited, emptyJob, placeKey} from './job';
import {Signal} from './signal';

/** A file that the server has been given. */
export interface Sent {
  readonly id: number;
  readonly name: string;
  readonly bytes: number;
}

/** What the server is asked about. */
export interface Asked {
  readonly model: Sent | null;
  readonly profile: Sent | null; // of the slicer
  readonly job: Job;
}

/** What is edited. Its points are in the coordinates of the placement `frame`. */
export interface Doc extends Asked {
  readonly frame: string;
}

export interface DocumentState {
  readonly history: History<Doc>;
  readonly wish: Job | null; // the job while a hand drags something
}

const opened = 'open';

/** The one document, its undo and redo, and the wish of a hand that has not come to rest. */
export class DocumentStore {
  readonly state = new Signal<DocumentState>({
    history: started<Doc>({model: null, profile: null, job: emptyJob, frame: placeKey(emptyJob)}), wish: null,
  });

  get doc(): Doc {
    return this.state.value.history.present.value;
  }

  /** The job as it is shown: the wish where there is one. */
  get job(): Job {
    return this.state.value.wish ?? this.doc.job;
  }

  /** As it is shown: with the wish where there is one. */
  get asked(): Asked {
    return {...this.doc, job: this.job};
  }

  open(model: Sent, job: Job = emptyJob, profile: Sent | null = null): void {
    this.#set(done(this.state.value.history, {model, profile, job, frame: placeKey(job)}, opened));
  }

  /** Ballast is infill, of which only a profile tells. */
  slice(profile: Sent | null): void {
    const job = profile ? this.doc.job : edited(this.doc.job, {ballast: undefined});
    this.#set(done(this.state.value.history, {...this.doc, profile, job}, 'profile'));
  }

  change(job: Job, label: string): void {
    if (JSON.stringify(job) === JSON.stringify(this.doc.job)) {
      this.state.patch({wish: null});
      return;
    }
    this.#set(done(this.state.value.history, {...this.doc, job}, label));
  }

  /** Takes a job as a whole: its points are in the coordinates of its own placement. */
  adopt(job: Job): void {
    this.#set(done(this.state.value.history, {...this.doc, job, frame: placeKey(job)}, 'open a job'));
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

  /** Whether anything would be lost with the page: more was done than opened. */
  get hasWork(): boolean {
    const {past, present} = this.state.value.history;
    return [...past, present].some(({value, label}) => value.model !== null && label !== opened);
  }

  #set(history: History<Doc>): void {
    this.state.set({history, wish: null});
  }
}

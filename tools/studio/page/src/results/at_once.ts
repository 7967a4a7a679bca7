import type {DocumentStore} from '../state/document';
import type {UiStore} from '../state/ui';
import {type ResultsStore, freshCheck, freshStand, keyOf} from './results';
import type {Runs} from './runs';

/** Where it is asked for, makes the model stand whenever the hand rests; once for each job, whatever comes of it. */
export function standAtOnce(documents: DocumentStore, results: ResultsStore, ui: UiStore, runs: Runs): void {
  let tried = '';
  const consider = () => {
    const {doc} = documents, now = results.value, key = keyOf(doc);
    if (!ui.value.atOnce || documents.state.value.wish || now.busy || key === tried) return;
    if (!freshCheck(now, doc) || freshStand(now, doc)) return;
    tried = key;
    void runs.stand();
  };
  results.subscribe(consider);
  ui.subscribe(consider);
}

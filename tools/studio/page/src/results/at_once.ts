import type {Bench} from '../tools/tool';
import {freshCheck, freshStand, keyOf} from './results';

/** Where it is asked for, makes the model stand whenever the hand rests; once for each job, whatever comes of it. */
export function standAtOnce({documents, results, ui, conductor}: Bench): void {
  let tried = '';
  const consider = () => {
    const {doc} = documents, now = results.value, key = keyOf(doc);
    if (!ui.value.atOnce || documents.state.value.wish || now.busy || key === tried) return;
    if (!freshCheck(now, doc) || freshStand(now, doc)) return;
    tried = key;
    void conductor.runs.stand();
  };
  results.subscribe(consider);
  ui.subscribe(consider);
}

import type {Bench} from '../tools/tool';
import {freshStand, isUnanswered} from '../results/results';
import {edited} from '../state/job';
import {h, icon, say} from './dom';
import type {Part} from './fields';
import {makeItStand} from './foot';
import {icons} from './icons';

const cannotStand = 3; // the program's exit code

/** What went wrong, in the program's own sentence. */
export function noticeBar(bench: Bench): Part {
  const {results, conductor, documents} = bench;
  const text = h('p', {});
  const again = h('button', {class: 'plain small', id: 'again', onclick: () => conductor.again()}, 'Try again');
  const bend = h('button', {class: 'plain small', id: 'let-bend', title: 'Cut a little off the base, and bend the outside a little', onclick: () => {
    documents.change(edited(documents.doc.job, {deform: 'auto'}), 'let it bend');
    makeItStand(bench);
  }}, 'Let the outside bend');
  const close = h('button', {class: 'round', 'aria-label': 'Dismiss', title: 'Dismiss', onclick: () =>
    results.patch({notice: null})}, icon(icons.close));
  const element = h('div', {class: 'notice', role: 'alert', id: 'notice'}, text, again, bend, close);
  const update = () => {
    const {notice} = results.value;
    element.hidden = notice === null;
    element.dataset.tone = notice?.tone ?? 'note';
    if (notice) say(text, notice.sentence);
    const tried = freshStand(results.value, documents.doc), stays = (documents.doc.job.deform ?? 'never') === 'never';
    bend.hidden = !(tried?.code === cannotStand && stays);
    again.hidden = !isUnanswered(results.value, documents.doc);
  };
  return {element, update};
}

import type {Bench} from '../tools/tool';
import {h, icon} from './dom';
import type {Part} from './fields';
import {icons} from './icons';

/** What went wrong, in the program's own sentence. */
export function noticeBar({results, conductor, documents}: Bench): Part {
  const text = h('p', {});
  const again = h('button', {class: 'plain small', id: 'again', onclick: () => conductor.again()}, 'Try again');
  const close = h('button', {class: 'round', 'aria-label': 'Dismiss', title: 'Dismiss', onclick: () =>
    results.patch({notice: null})}, icon(icons.close));
  const element = h('div', {class: 'notice', role: 'alert', id: 'notice'}, text, again, close);
  const update = () => {
    const {notice} = results.value;
    element.hidden = notice === null;
    if (notice && text.textContent !== sentence(notice.sentence)) text.textContent = sentence(notice.sentence);
    again.hidden = documents.doc.model === null || results.value.check !== null;
  };
  return {element, update};
}

/** As it was said, with a capital letter at its head. */
function sentence(said: string): string {
  return said;
}

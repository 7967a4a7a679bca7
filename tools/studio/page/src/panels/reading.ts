import type {Bench} from '../tools/tool';
import {h, say} from './dom';
import type {Part} from './fields';

/** Says that a file is being read: what is shown until then is what was open before. */
export function readingBar({results, conductor}: Bench): Part {
  const text = h('span', {role: 'status'});
  const element = h('div', {class: 'reading', id: 'reading'}, h('progress', {'aria-label': 'Reading'}), text,
                    h('button', {class: 'plain small', onclick: () => conductor.opening.cancel()}, 'Cancel'));
  const update = () => {
    const {busy} = results.value;
    element.hidden = busy?.what !== 'open';
    say(text, busy?.what === 'open' ? `${busy.stage}\u2026` : '');
  };
  return {element, update};
}

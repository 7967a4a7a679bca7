import {keyList} from '../keys';
import {h, icon} from './dom';
import {icons} from './icons';

/** A dialog with a title; Escape and a press beside it close it. */
export function dialog(title: string, body: HTMLElement): HTMLDialogElement {
  const close = h('button', {class: 'round', 'aria-label': 'Close', onclick: () => element.close()}, icon(icons.close));
  const element = h('dialog', {'aria-label': title, onclick: (event: MouseEvent) => {
    if (event.target === element) element.close();
  }}, h('div', {class: 'dialog-body'}, h('div', {class: 'dialog-head'}, h('h2', {}, title), close), body));
  return element;
}

export function keysTable(): HTMLElement {
  return h('table', {class: 'keys'}, ...keyList.map(([keys, does]) =>
    h('tr', {}, h('th', {scope: 'row'}, ...keys.split(' ').flatMap((key) => [h('kbd', {}, key.replace(',', '')), ' '])), h('td', {}, does))));
}

/** Asks before something is done that cannot be undone. The answer that does nothing is at hand. */
export function question(title: string, text: string, deed: string, act: () => void): HTMLDialogElement {
  const yes = h('button', {class: 'plain', 'data-answer': 'yes', onclick: act}, deed);
  const no = h('button', {class: 'plain primary', autofocus: true, onclick: () => element.close()}, 'Stay here');
  const element = dialog(title, h('div', {class: 'question'}, h('p', {}, text), h('div', {class: 'answers'}, yes, no)));
  return element;
}

import type {Bench} from '../tools/tool';
import type {Theme} from '../theme';
import {h, icon} from './dom';
import type {Part} from './fields';
import {icons} from './icons';

interface Actions {
  readonly open: () => void;
  readonly help: () => void;
}

/** What is open, the verdict, and the buttons that are always there. */
export function topBar({documents}: Bench, verdict: HTMLElement, theme: Theme, actions: Actions): Part {
  const name = h('span', {class: 'model-name'});
  const open = h('button', {class: 'opener', id: 'open', title: 'Open another model (Ctrl+O)', onclick: actions.open},
                 icon(icons.open), name);
  const undo = round('undo', 'Undo', () => documents.undo()), redo = round('redo', 'Redo', () => documents.redo());
  const light = round('light', 'Light or dark', () => theme.toggle()), help = round('help', 'Keys', actions.help);
  const element = h('header', {class: 'top'}, h('div', {class: 'brand'}, h('span', {class: 'mark-word'}, 'Aplomb'), open), verdict,
                    h('div', {class: 'buttons'}, undo, redo, h('span', {class: 'gap'}), light, help));
  const update = () => {
    const {history} = documents.state.value;
    name.textContent = documents.doc.model?.name ?? 'Open\u2026';
    undo.disabled = !documents.canUndo;
    redo.disabled = !documents.canRedo;
    undo.title = `Undo${documents.canUndo ? `: ${history.present.label}` : ''} (Ctrl+Z)`;
    redo.title = `Redo${documents.canRedo ? `: ${history.future[0]!.label}` : ''} (Ctrl+Shift+Z)`;
  };
  return {element, update};
}

function round(name: keyof typeof icons, label: string, press: () => void): HTMLButtonElement {
  return h('button', {class: 'round', id: name, 'aria-label': label, title: label, onclick: press}, icon(icons[name]));
}

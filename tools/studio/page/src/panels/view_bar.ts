import type {Look} from '../state/ui';
import type {Bench} from '../tools/tool';
import {figuresOf} from '../results/verdict';
import type {Side} from '../view/stage';
import {asToolbar, h} from './dom';
import type {Part} from './fields';

const looks: readonly (readonly [Look, string, string])[] = [
  ['solid', 'Solid', '1'], ['xray', 'See through', '2'], ['section', 'Cut', '3'],
];
const sides: readonly (readonly [Side, string])[] = [['corner', 'All'], ['front', 'Front'], ['right', 'Right'], ['top', 'Top']];

/** How the scene is looked at. */
export function viewBar(bench: Bench): Part {
  const {ui, view, documents, results, conductor} = bench;
  const lookButtons = looks.map(([look, name, key]) => h('button', {
    'data-look': look, 'aria-pressed': false, title: `${name} (${key})`, onclick: () => ui.patch({look}),
  }, name));
  const axes = (['x', 'y', 'z'] as const).map((axis) => h('button', {
    'aria-pressed': false, 'data-axis': axis, title: `Cut across ${axis}`, onclick: () => ui.patch({cutAxis: axis}),
  }, axis));
  const slider = h('input', {type: 'range', min: '0', max: '1', step: '0.005', 'aria-label': 'Where it is cut', id: 'cut-at',
                             oninput: () => ui.patch({cutAt: Number(slider.value)})});
  const cut = h('div', {class: 'group cut'}, h('div', {class: 'segments', role: 'group', 'aria-label': 'Cut across'}, ...axes), slider);
  const ring = h('button', {class: 'plain small', 'aria-pressed': true, title: 'Tip angle by direction, on the plate', onclick: () =>
    ui.patch({ring: !ui.value.ring})}, 'Ring');
  const fall = h('button', {class: 'plain small', id: 'fall', title: 'Show how it falls (Space)', onclick: () => view.fall()}, 'Let it fall');
  const element = h('div', {class: 'view-bar', role: 'toolbar', 'aria-label': 'View'},
    h('div', {class: 'segments', role: 'group', 'aria-label': 'How it is drawn'}, ...lookButtons), cut,
    h('div', {class: 'segments', role: 'group', 'aria-label': 'Seen from'}, ...sides.map(([side, name]) =>
      h('button', {onclick: () => view.lookFrom(side), title: `See ${name.toLowerCase()}`}, name))), ring, fall);
  const keepStop = asToolbar(element);
  const update = () => {
    element.hidden = documents.doc.model === null;
    for (const button of lookButtons) button.setAttribute('aria-pressed', String(button.dataset.look === ui.value.look));
    for (const button of axes) button.setAttribute('aria-pressed', String(button.dataset.axis === ui.value.cutAxis));
    cut.hidden = ui.value.look !== 'section';
    slider.value = String(ui.value.cutAt);
    ring.setAttribute('aria-pressed', String(ui.value.ring));
    fall.disabled = !figuresOf(results.value, documents.asked, ui.value.pose, conductor.answering)?.figures.weak_edge;
    keepStop();
  };
  return {element, update};
}

import {toolKeys} from '../keys';
import {isBent} from '../results/results';
import {type ToolName, takesPoints} from '../state/ui';
import type {Bench} from '../tools/tool';
import type {Toolbox} from '../tools/toolbox';
import {brushOf} from '../tools/tool';
import {asToolbar, h, icon, say} from './dom';
import type {Part} from './fields';
import {icons} from './icons';

const names: readonly (readonly [ToolName, string])[] = [
  ['look', 'Look'], ['face', 'Lay flat'], ['turn', 'Turn'], ['touch', 'Touches'], ['handle', 'Handle'], ['lock', 'Lock'],
];
const withBrush: readonly ToolName[] = ['touch', 'handle', 'lock'];

/** The tools, and what the one in hand does. */
export function toolRail(bench: Bench, toolbox: Toolbox): Part & {readonly hint: HTMLElement} {
  const {ui, documents, results} = bench;
  const buttons = names.map(([tool, name]) => h('button', {
    class: 'tool', 'data-tool': tool, 'aria-pressed': false, title: `${name} (${toolKeys[tool]}): ${toolbox.tools[tool].hint}`,
    onclick: () => ui.patch({tool}),
  }, icon(icons[tool]), h('span', {}, name)));
  const element = h('div', {class: 'rail', role: 'toolbar', 'aria-label': 'Tools', 'aria-orientation': 'vertical'}, ...buttons);
  const keepStop = asToolbar(element);
  const text = h('span', {}), size = h('output', {});
  const slider = h('input', {type: 'range', min: '1', max: '40', step: '1', 'aria-label': 'Size of the brush', oninput: () =>
    ui.patch({brushPercent: Number(slider.value)})});
  const brush = h('label', {class: 'brush'}, 'size ', slider, size);
  const hint = h('div', {class: 'hint'}, text, brush);
  const besides = () => {
    if (takesPoints(ui.value.tool) && isBent(results.value, documents.doc)) return `Shown is the model, not what was made: that is under Look (${toolKeys.look}).`;
    return ui.value.tool === 'handle' && ui.value.atOnce ? 'When the hand rests, the full answer follows.' : '';
  };
  const update = () => {
    element.hidden = hint.hidden = documents.doc.model === null;
    for (const button of buttons) button.setAttribute('aria-pressed', String(button.dataset.tool === ui.value.tool));
    keepStop();
    say(text, `${toolbox.tool.hint} ${besides()}`.trim());
    brush.hidden = !withBrush.includes(ui.value.tool);
    slider.value = String(ui.value.brushPercent);
    size.textContent = `${brushOf(bench).toFixed(1)} mm`;
  };
  return {element, hint, update};
}

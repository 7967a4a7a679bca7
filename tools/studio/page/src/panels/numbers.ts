import type {Bench} from '../tools/tool';
import type {Figures} from '../results/report';
import {figuresOf} from '../results/verdict';
import {brief} from '../results/words';
import {h} from './dom';
import {type Part, section} from './fields';

const rows: readonly (readonly [string, string, (figures: Figures) => number | null | undefined])[] = [
  ['Mass', 'g', (f) => f.mass_g],
  ['Centre of mass', 'mm up', (f) => f.com_height_mm],
  ['Inside its support', 'mm', (f) => f.margin_mm],
  ['With tolerances', '°', (f) => f.robust_tip_deg],
  ['Push that topples it', 'N', (f) => f.topple_push_n],
  ['Below its thread', 'mm', (f) => f.drop_mm],
];

/** What was measured, before and after. */
export function numbersPanel({documents, results, ui, conductor}: Bench): Part {
  const table = h('table', {class: 'numbers'});
  const update = () => {
    const found = figuresOf(results.value, documents.asked, ui.value.pose, conductor.answering);
    folded.element.hidden = found === null;
    if (!found) return;
    const {before, after} = found.pose;
    const head = h('tr', {}, h('th', {}), h('th', {scope: 'col'}, documents.doc.profile ? 'sliced' : 'solid'), after ? h('th', {scope: 'col'}, 'made') : null, h('th', {}));
    table.replaceChildren(head, ...rows.flatMap(([name, unit, value]) => {
      const was = value(before), is = after ? value(after) : null;
      if (typeof was !== 'number') return [];
      return [h('tr', {}, h('th', {scope: 'row'}, name), h('td', {}, brief(was)),
                after ? h('td', {}, typeof is === 'number' ? brief(is) : '') : null, h('td', {class: 'soft'}, unit))];
    }));
  };
  const folded = section('In numbers', [{element: table, update}], false);
  return folded;
}

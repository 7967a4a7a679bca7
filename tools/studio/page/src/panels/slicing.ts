import type {Bench} from '../tools/tool';
import {type Job, edited} from '../state/job';
import {h, icon, newId, say} from './dom';
import {type Part, choiceField, section} from './fields';
import {icons} from './icons';

const hint = 'PrusaSlicer’s .ini or G-code, or Cura’s settings: mass and balance are then those of the print, with its walls and infill';

/** How the slicer will fill it, where that is known. */
export function slicingPanel(bench: Bench): Part & {readonly element: HTMLDetailsElement} {
  const {documents} = bench;
  const job = () => documents.doc.job;
  const moved = choiceField({
    label: 'Moves mass', hint: 'Denser infill on one side leaves outside and inside as they are',
    value: () => job().ballast ?? 'auto',
    options: () => [['auto', 'by infill, if sparse'], ['never', 'by a void'], ['only', 'by infill alone']],
    change: (value) => documents.change(
      edited(job(), {ballast: value === 'auto' ? undefined : (value as Job['ballast'])}), 'what moves mass'),
  });
  const folded = section('Slicing', [profileField(bench), {
    element: moved.element,
    update: () => {
      moved.element.hidden = documents.doc.profile === null;
      moved.update();
    },
  }], false);
  let hadProfile = false;
  return {
    element: folded.element,
    update: () => {
      const {profile} = documents.doc;
      if (profile && !hadProfile) folded.element.open = true;
      hadProfile = profile !== null;
      folded.update();
    },
  };
}

/** The file that says so: chosen, shown, taken away. */
function profileField({documents, conductor}: Bench): Part {
  const id = newId();
  const pick = h('input', {type: 'file', accept: '.ini,.gcode,.gco,.g,.cfg,.json', class: 'unseen', tabIndex: -1, id: 'profile-file',
                           'aria-label': 'Profile file', onchange: () => {
    const file = pick.files?.[0];
    if (file) void conductor.opening.take(file);
    pick.value = '';
  }});
  const choose = h('button', {id, class: 'plain small named', title: hint, onclick: () => pick.click()});
  const drop = h('button', {class: 'round', 'aria-label': 'Without a profile', title: 'Without a profile', onclick: () =>
    documents.slice(null)}, icon(icons.close));
  const element = h('div', {class: 'field'}, h('label', {for: id}, 'Profile'), h('span', {class: 'row'}, choose, drop, pick));
  return {
    element,
    update: () => {
      const {profile, model} = documents.doc;
      say(choose, profile?.name ?? 'Choose a file\u2026');
      choose.disabled = model === null;
      drop.hidden = profile === null;
    },
  };
}

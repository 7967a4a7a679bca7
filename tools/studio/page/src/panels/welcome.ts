import type {Start} from '../start';
import type {Opening} from '../results/opening';
import {h, icon} from './dom';
import {icons} from './icons';

const mega = 1024 * 1024;

/** An invitation to drop a file or to open a fixture; on the empty page, and in the dialog that opens another model. */
export function invitation(start: Start, opening: Opening, chosen: () => void): HTMLElement {
  const pick = h('input', {type: 'file', accept: '.stl,.obj,.ply,.off,.3mf,.json', class: 'unseen', tabIndex: -1, 'aria-label': 'Model file', onchange: () => {
    const file = pick.files?.[0];
    if (file) void opening.take(file);
    pick.value = '';
    chosen();
  }});
  const fixtures = start.fixtures.map(({name}) => h('button', {class: 'fixture', 'data-fixture': name, onclick: () => {
    void opening.fixture(name);
    chosen();
  }}, name.replace(/\.[^.]+$/, '').replaceAll('_', ' ')));
  return h('div', {class: 'invitation'}, icon(icons.falls), h('h2', {}, 'Drop a model here'),
    h('p', {class: 'soft'}, `STL, OBJ, PLY, OFF or 3MF, up to ${Math.round(start.limits.upload_bytes / mega)} MB. It stays on this computer.`),
    h('button', {class: 'primary', onclick: () => pick.click()}, 'Choose a file\u2026'), pick,
    fixtures.length ? h('div', {class: 'fixtures'}, h('p', {class: 'soft'}, 'or try one of these figures'), h('div', {class: 'fixture-list'}, ...fixtures)) : null);
}

/** Takes files that are dropped anywhere on the page: models, and jobs and slicers' profiles for the model that is open. */
export function takeDrops(room: HTMLElement, opening: Opening): void {
  let inside = 0;
  const mark = () => room.classList.toggle('dropping', inside > 0);
  addEventListener('dragenter', (event) => (event.preventDefault(), ++inside, mark()));
  addEventListener('dragleave', () => (--inside, mark()));
  addEventListener('dragover', (event) => event.preventDefault());
  addEventListener('drop', (event) => {
    event.preventDefault();
    inside = 0;
    mark();
    const file = event.dataTransfer?.files[0];
    if (file) void opening.take(file);
  });
}

import type {Start} from '../start';
import type {Conductor} from '../results/conductor';
import {h, icon} from './dom';
import {icons} from './icons';

const mega = 1024 * 1024;

/** An invitation to drop a file or to open a fixture; on the empty page, and in the dialog that opens another model. */
export function invitation(start: Start, conductor: Conductor, chosen: () => void): HTMLElement {
  const pick = h('input', {type: 'file', accept: '.stl,.obj,.ply,.off,.3mf', class: 'unseen', tabIndex: -1, 'aria-label': 'Model file', onchange: () => {
    const file = pick.files?.[0];
    if (file) void conductor.openFile(file);
    pick.value = '';
    chosen();
  }});
  const fixtures = start.fixtures.map(({name}) => h('button', {class: 'fixture', 'data-fixture': name, onclick: () => {
    void conductor.openFixture(name);
    chosen();
  }}, name.replace(/\.[^.]+$/, '').replaceAll('_', ' ')));
  return h('div', {class: 'invitation'}, icon(icons.falls), h('h2', {}, 'Drop a model here'),
    h('p', {class: 'soft'}, `STL, OBJ, PLY, OFF or 3MF, up to ${Math.round(start.limits.upload_bytes / mega)} MB. It stays on this computer.`),
    h('button', {class: 'primary', id: 'choose', onclick: () => pick.click()}, 'Choose a file\u2026'), pick,
    fixtures.length ? h('div', {class: 'fixtures'}, h('p', {class: 'soft'}, 'or try one of these figures'), h('div', {class: 'fixture-list'}, ...fixtures)) : null);
}

/** Takes files that are dropped anywhere on the page. */
export function takeDrops(room: HTMLElement, conductor: Conductor): void {
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
    if (file) void conductor.openFile(file);
  });
}

import type {Bench} from '../tools/tool';
import {type Vec3, edited, withHandle, withHandles} from '../state/job';
import {type Kept, h, keeper} from './dom';
import {type Part, numberField, tripleField} from './fields';

/** The handles and locks of the job, with numbers for the handle in hand. */
export function shapePanel(bench: Bench): Part {
  const {documents, ui} = bench;
  const list = h('div', {class: 'chips', role: 'group', 'aria-label': 'Handles'}), keepChips = keeper(list, (index) => chip(bench, index));
  const handle = () => documents.job.handles?.[ui.value.handle ?? -1];
  const change = (fields: Partial<NonNullable<ReturnType<typeof handle>>>) => {
    const now = documents.doc.job.handles?.[ui.value.handle ?? -1];
    if (now) documents.change(withHandle(documents.doc.job, ui.value.handle!, edited(now, fields)), 'move a handle');
  };
  const fields = [
    tripleField('To', 'mm', 1, () => handle()?.to_mm ?? handle()?.at_mm, (to_mm) => change({to_mm: to_mm as Vec3})),
    tripleField('Turn', '°', 5, () => handle()?.turn_deg, (turn) => change({turn_deg: turn.some((v) => v !== 0) ? turn : undefined})),
    numberField({label: 'Scale', unit: '×', min: 0.2, max: 5, step: 0.05, value: () => handle()?.scale, standard: () => '1', change: (scale) => change({scale})}),
    numberField({label: 'Radius', unit: 'mm', min: 0, step: 1, value: () => handle()?.radius_mm, standard: () => '0', change: (radius_mm) => change({radius_mm})}),
  ];
  const body = h('div', {class: 'handle-body'}, ...fields.map((field) => field.element));
  const text = h('span', {}), unlock = h('button', {class: 'quiet', onclick: () =>
    documents.change(edited(documents.doc.job, {lock: undefined}), 'unlock')}, 'Unlock all');
  const moved = h('p', {class: 'soft', id: 'moved'});
  const locks = h('div', {class: 'field'}, h('span', {class: 'label'}, 'Locked'), h('span', {class: 'row'}, text, unlock));
  const element = h('details', {open: true, class: 'section'}, h('summary', {}, 'Shape'), list, moved, body, locks);
  const update = () => {
    const handles = documents.job.handles ?? [], count = documents.job.lock?.length ?? 0;
    element.hidden = handles.length === 0 && count === 0;
    keepChips(handles.length);
    body.hidden = handle() === undefined;
    fields.forEach((field) => field.update());
    text.textContent = count ? 'where painted' : 'nothing';
    locks.hidden = count === 0;
    moved.textContent = bench.view.moved_mm.value > 0 ? movedText(bench) : '';
    moved.hidden = moved.textContent === '';
  };
  return {element, update};
}

function movedText({view, results}: Bench): string {
  const preview = results.value.preview?.preview, rate = results.value.previewsPerSecond;
  const short = preview && preview.handle_short_mm > 0.05 ? `; the handle lacks ${preview.handle_short_mm.toFixed(1)} mm` : '';
  return `Moved by up to ${view.moved_mm.value.toFixed(1)} mm${short}${rate ? `; ${rate.toFixed(1)} previews a second` : ''}`;
}

function chip({documents, ui}: Bench, index: number): Kept {
  const take = h('button', {class: 'chip', onclick: () => ui.patch({handle: index, tool: 'handle'})}, `handle ${index + 1}`);
  const drop = h('button', {class: 'chip-drop', 'aria-label': `Remove handle ${index + 1}`, title: 'Remove', onclick: () => {
    const rest = (documents.doc.job.handles ?? []).filter((_, at) => at !== index);
    ui.patch({handle: null});
    documents.change(withHandles(documents.doc.job, rest), 'remove a handle');
  }}, '×');
  return {
    element: h('span', {class: 'chip-pair'}, take, drop),
    update: () => take.setAttribute('aria-pressed', String(ui.value.handle === index)),
  };
}

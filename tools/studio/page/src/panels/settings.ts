import type {Start} from '../start';
import type {Bench} from '../tools/tool';
import {type Axis, type Job, edited, withPlace} from '../state/job';
import {type Part, choiceField, numberField, section, switchField, tripleField} from './fields';

const materialNames: Record<string, string> = {
  pla: 'PLA', petg: 'PETG', abs: 'ABS', asa: 'ASA', tpu: 'TPU', resin: 'resin', pa12: 'PA12',
};
const processNames: Record<string, string> = {
  fdm: 'filament (FDM)', sla: 'resin (SLA)', powder: 'powder', binder: 'binder jet',
};

/** How the model is placed on the plate. */
export function placePanel({documents, results}: Bench): Part {
  const place = () => documents.doc.job.place ?? {};
  const change = (fields: Parameters<typeof withPlace>[1], label: string) =>
    documents.change(withPlace(documents.doc.job, fields), label);
  const box = () => results.value.placed?.placed.box_mm;
  return section('Placement', [
    choiceField({
      label: 'Up in the file', value: () => place().up ?? '',
      options: () => [['', 'z, as it is'], ['y', 'y'], ['x', 'x'], ['-z', '−z'], ['-y', '−y'], ['-x', '−x']],
      change: (value) => change({up: value ? (value as Axis) : undefined}, 'up'),
    }),
    tripleField('Turn', '°', 5, () => place().rotate_deg,
                (turn) => change({rotate_deg: turn.some((value) => value !== 0) ? turn : undefined}, 'turn')),
    numberField({
      label: 'Height', unit: 'mm', min: 0.001, step: 1, value: () => place().height_mm,
      standard: () => (box() ? (box()![1][2] - box()![0][2]).toFixed(1) : ''), change: (height_mm) => change({height_mm}, 'height'),
    }),
  ], false);
}

/** What is asked of carving, and how it is printed. */
export function makingPanel({documents}: Bench, start: Start): Part {
  const job = () => documents.doc.job;
  const change = (fields: Partial<Job>, label: string) => documents.change(edited(job(), fields), label);
  const process = () => start.processes.find((one) => one.name === (job().process ?? 'fdm'));
  return section('Making', [
    choiceField({
      label: 'Aim', hint: 'What the void inside is chosen for', value: () => job().aim ?? 'least',
      options: () => [['least', 'remove the least'], ['light', 'remove the most'], ['stable', 'stand the firmest']],
      change: (value) => change({aim: value === 'least' ? undefined : (value as Job['aim'])}, 'aim'),
    }),
    choiceField({
      label: 'Outside', hint: 'Whether the outside may be cut and bent', value: () => job().deform ?? 'never',
      options: () => [['never', 'stays as it is'], ['auto', 'bends if needed'], ['only', 'bends, is not carved']],
      change: (value) => change({deform: value === 'never' ? undefined : (value as Job['deform']),
                                 ...(value === 'never' ? {handles: undefined} : {})}, 'outside'),
    }),
    choiceField({
      label: 'Process', value: () => job().process ?? 'fdm',
      options: () => start.processes.map(({name}) => [name, processNames[name] ?? name]),
      change: (value) => change({process: value === 'fdm' ? undefined : value}, 'process'),
    }),
    choiceField({
      label: 'Material', value: () => job().material ?? 'pla',
      options: () => start.materials.map((name) => [name, materialNames[name] ?? name]),
      change: (value) => change({material: value === 'pla' ? undefined : value}, 'material'),
    }),
    numberField({
      label: 'Wall', unit: 'mm', min: 0.1, step: 0.1, hint: 'Least material between void and outside',
      value: () => job().wall_mm, standard: () => String(process()?.wall_mm ?? ''), change: (wall_mm) => change({wall_mm}, 'wall'),
    }),
    switchField('Robust', 'Ask the angle of the worst case within the tolerances of printing', () => job().robust === true,
                (on) => change({robust: on || undefined}, 'robust')),
  ]);
}

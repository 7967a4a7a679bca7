import type {Bench} from '../tools/tool';
import type {Client} from '../transport/client';
import {freshStand} from '../results/results';
import {h, say} from './dom';
import {type Part, switchField} from './fields';

const kinds = [['3mf', 'Save 3MF'], ['stl', 'STL'], ['html', 'Report'], ['job', 'Job']] as const;

/** The button that does it all, its progress, and what there is to take away. */
export function foot(bench: Bench, client: Client): Part {
  const {documents, results, ui, conductor} = bench;
  const make = h('button', {class: 'primary', id: 'make', title: 'Ctrl+Enter', onclick: () => void conductor.runs.stand()}, 'Make it stand');
  const bar = h('progress', {max: 1, id: 'progress'}), stage = h('span', {class: 'stage'});
  const cancel = h('button', {class: 'plain', id: 'cancel', title: 'Escape', onclick: () => void conductor.cancel()}, 'Cancel');
  const running = h('div', {class: 'running', role: 'group', 'aria-label': 'Progress'}, h('div', {}, stage, bar), cancel);
  const take = kinds.map(([what, text]) => h('button', {
    class: 'plain', 'data-take': what, disabled: true, onclick: () => void save(bench, client, what),
  }, text));
  const once = switchField('Answer at once', 'Make it stand again whenever the hand rests', () => ui.value.atOnce,
                           (atOnce) => ui.patch({atOnce}));
  const element = h('footer', {class: 'foot'}, make, running, h('div', {class: 'take', role: 'group', 'aria-label': 'Take away'}, ...take), once.element);
  const update = () => {
    const {busy} = results.value, runs = busy?.what === 'stand' || busy?.what === 'validate';
    const made = freshStand(results.value, documents.doc), isDone = made?.code === 0;
    make.hidden = runs;
    running.hidden = !runs;
    make.disabled = documents.doc.model === null || busy !== null || (made !== null && made.code !== null);
    say(make, isDone ? 'Made' : made?.code ? 'Tried' : 'Make it stand');
    make.classList.toggle('primary', !isDone);
    if (runs) {
      say(stage, stageText(busy.what, busy.stage));
      if (busy.fraction === null) bar.removeAttribute('value');
      else bar.value = busy.fraction;
      bar.setAttribute('aria-label', busy.stage);
    }
    for (const button of take) {
      button.disabled = documents.doc.model === null || (button.dataset.take !== 'job' && !isDone);
      button.classList.toggle('primary', button.dataset.take === '3mf' && isDone);
      button.title = button.disabled && documents.doc.model ? 'Make it stand first' : '';
    }
    once.update();
  };
  return {element, update};
}

const stages: Record<string, string> = {
  read: 'Reading', repair: 'Looking for holes', voxelize: 'Filling with voxels', carve: 'Carving', shell: 'Drawing the void',
  ceilings: 'Shaping ceilings', judge: 'Judging how it prints', write: 'Writing', picture: 'Drawing the report', deform: 'Bending',
};

function stageText(what: 'stand' | 'validate' | string, stage: string): string {
  return `${stages[stage] ?? (stage ? stage[0]!.toUpperCase() + stage.slice(1) : what)}\u2026`;
}

/** Saves what the server wrote, by the name that it gives it. */
export async function save(bench: Bench, client: Client, what: string): Promise<void> {
  const {doc} = bench.documents;
  try {
    const file = await client.file('/api/take', {model: doc.model?.id, job: doc.job, what});
    const address = URL.createObjectURL(file.bytes);
    h('a', {href: address, download: file.name}).click();
    setTimeout(() => URL.revokeObjectURL(address), 60_000);
  } catch (error) {
    bench.conductor.fail(error);
  }
}

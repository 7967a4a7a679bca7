import type {Bench} from '../tools/tool';
import type {Client} from '../transport/client';
import {type StandResult, bodyOf, freshStand} from '../results/results';
import {h, say} from './dom';
import {type Part, switchField} from './fields';

const kinds = [['3mf', 'Save 3MF'], ['stl', 'STL'], ['html', 'Report'], ['job', 'Job']] as const;
type Kind = (typeof kinds)[number][0];

/** The button that does it all, its progress, and what there is to take away. */
export function foot(bench: Bench, client: Client): Part {
  const {documents, results, ui, conductor} = bench;
  const make = h('button', {class: 'primary', id: 'make', title: 'Ctrl+Enter', onclick: () => makeItStand(bench)}, 'Make it stand');
  const bar = h('progress', {max: 1, id: 'progress'}), stage = h('span', {class: 'stage'});
  const cancel = h('button', {class: 'plain', id: 'cancel', title: 'Escape', onclick: () => conductor.cancel()}, 'Cancel');
  const running = h('div', {class: 'running', role: 'group', 'aria-label': 'Progress'}, h('div', {}, stage, bar), cancel);
  const take = kinds.map(([what, text]) => h('button', {
    class: 'plain', 'data-take': what, disabled: true, onclick: () => void save(bench, client, what),
  }, text));
  const once = switchField('Answer at once', 'Make it stand again whenever the hand rests', () => ui.value.atOnce === true,
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
      const what = button.dataset.take as Kind;
      button.disabled = documents.doc.model === null || !mayTake(what, made);
      button.classList.toggle('primary', what === '3mf' && !button.disabled);
      button.title = button.disabled && documents.doc.model ? whyNot(what, made) : '';
    }
    once.update();
  };
  return {element, update};
}

/** Meshes may be taken as soon as they are written; the report is drawn after them. */
function mayTake(what: Kind, made: StandResult | null): boolean {
  if (what === 'job') return true;
  if (what === 'html') return made !== null && made.code !== null;
  return made?.isWritten === true && !(what === 'stl' && made.dense);
}

function whyNot(what: Kind, made: StandResult | null): string {
  if (what === 'html' && made) return 'It is drawn last';
  return what === 'stl' && made?.dense ? 'An STL cannot hold denser infill: take the 3MF' : 'Make it stand first';
}

const stages: Record<string, string> = {
  read: 'Reading', repair: 'Looking for holes', voxelize: 'Filling with voxels', carve: 'Carving', shell: 'Drawing the void',
  ceilings: 'Shaping ceilings', judge: 'Judging how it prints', write: 'Writing', picture: 'Drawing the report', deform: 'Bending',
};

function stageText(what: 'stand' | 'validate' | string, stage: string): string {
  return `${stages[stage] ?? (stage ? stage[0]!.toUpperCase() + stage.slice(1) : what)}\u2026`;
}

/** Makes it stand. What may bend is looked at then: a tool that takes its points from the model would show that in its place. */
export function makeItStand({documents, ui, conductor}: Bench): void {
  if ((documents.doc.job.deform ?? 'never') !== 'never') ui.patch({tool: 'look'});
  void conductor.runs.stand();
}

/** Saves what the server wrote, by the name that it gives it. */
export async function save(bench: Bench, client: Client, what: Kind): Promise<void> {
  const {doc} = bench.documents, made = freshStand(bench.results.value, doc);
  if (!doc.model) return;
  if (!mayTake(what, made)) return bench.results.patch({notice: {tone: 'note', sentence: `${whyNot(what, made)}.`}});
  try {
    const file = await client.file('/api/take', {...bodyOf(doc), what});
    const address = URL.createObjectURL(file.bytes);
    h('a', {href: address, download: file.name}).click();
    setTimeout(() => URL.revokeObjectURL(address), 60_000);
  } catch (error) {
    bench.conductor.fail(error);
  }
}

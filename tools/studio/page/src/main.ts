import './style/palette.css';
import './style/layout.css';
import './style/panel.css';
import './style/marks.css';
import './style/controls.css';

import {listenToKeys} from './keyboard';
import {dialog, keysTable, question} from './panels/dialogs';
import {h} from './panels/dom';
import type {Part} from './panels/fields';
import {findingsPanel} from './panels/findings';
import {foot, makeItStand, save} from './panels/foot';
import {noticeBar} from './panels/notice';
import {numbersPanel} from './panels/numbers';
import {posePanel} from './panels/pose_tabs';
import {toolRail} from './panels/rail';
import {readingBar} from './panels/reading';
import {makingPanel, placePanel} from './panels/settings';
import {slicingPanel} from './panels/slicing';
import {shapePanel} from './panels/shapes';
import {topBar} from './panels/top_bar';
import {verdictLine} from './panels/verdict_line';
import {viewBar} from './panels/view_bar';
import {invitation, takeDrops} from './panels/welcome';
import {standAtOnce} from './results/at_once';
import {Conductor} from './results/conductor';
import {withoutFiles} from './results/job_file';
import {type Results, nothing} from './results/results';
import type {Start} from './start';
import {DocumentStore} from './state/document';
import {Signal} from './state/signal';
import {newUi} from './state/ui';
import {Theme} from './theme';
import type {Bench} from './tools/tool';
import {Toolbox} from './tools/toolbox';
import {Client, tokenOf} from './transport/client';
import {View} from './view/view';

const root = document.getElementById('studio') as HTMLElement;

/** The whole page over a server that has let it in. */
function build(client: Client, start: Start): void {
  const documents = new DocumentStore(), results = new Signal<Results>(nothing), ui = newUi();
  const conductor = new Conductor(client, documents, results, start.limits.upload_bytes);
  const canvas = h('canvas', {'aria-label': 'The model on its plate; arrows go round it', role: 'application', tabIndex: 0});
  const marks = h('div', {class: 'marks'}), room = h('main', {class: 'room'}, canvas, marks);
  root.replaceChildren(room);
  const view = new View(canvas, marks, documents, results, ui, () => conductor.answering);
  const theme = new Theme(() => view.repaint());
  const bench: Bench = {documents, results, ui, view, conductor};
  const toolbox = new Toolbox(bench);

  const {opening} = conductor;
  const choosing = dialog('Open', invitation(start, opening, () => choosing.close()));
  const ending = question('End Aplomb Studio', 'The server ends, and with it what has not been saved.', 'End it', () => {
    removeEventListener('beforeunload', keepWork);
    void quit(client);
  });
  const keys = dialog('Keys', h('div', {}, keysTable(), h('button', {class: 'plain', id: 'quit', onclick: () => {
    keys.close();
    ending.showModal();
  }}, 'End Aplomb Studio')));
  const actions = {
    open: () => choosing.showModal(), help: () => keys.showModal(), make: () => makeItStand(bench), save: () => void save(bench, client, '3mf'),
  };
  const welcome = h('section', {class: 'welcome', 'aria-label': 'Open a model'}, invitation(start, opening, () => undefined));
  const rail = toolRail(bench, toolbox), bar = viewBar(bench), notice = noticeBar(bench), reading = readingBar(bench);
  const verdict = verdictLine(bench), top = topBar(bench, verdict.element, theme, actions);
  const scrolled = [posePanel(bench), makingPanel(bench, start), slicingPanel(bench), placePanel(bench), shapePanel(bench), findingsPanel(bench), numbersPanel(bench)];
  const last = foot(bench, client);
  room.append(welcome, notice.element, reading.element, rail.element, rail.hint, bar.element);
  const panel = h('aside', {class: 'panel', 'aria-label': 'The job'}, h('div', {class: 'scrolled'}, ...scrolled.map((part) => part.element)), last.element);
  root.replaceChildren(top.element, room, panel, choosing, keys, ending);

  const parts: Part[] = [verdict, top, rail, bar, notice, reading, ...scrolled, last];
  let wasEmpty = true;
  const update = oncePerPicture(() => {
    const isEmpty = documents.doc.model === null && results.value.busy?.what !== 'read';
    welcome.hidden = !isEmpty;
    if (root.classList.toggle('empty', isEmpty) !== wasEmpty && !isEmpty) requestAnimationFrame(() => view.lookFrom('corner')); // the room is narrower
    wasEmpty = isEmpty;
    for (const part of parts) part.update();
  });
  for (const store of [documents.state, results, ui, view.moved_mm]) (store as Signal<unknown>).subscribe(update);
  update();
  takeDrops(room, opening);
  standAtOnce(documents, results, ui, conductor.runs);
  listenToKeys(bench, toolbox, actions);
  const keepWork = (event: BeforeUnloadEvent) => documents.hasWork && event.preventDefault();
  addEventListener('beforeunload', keepWork);
  if (start.model) void opening.begin(start.model, withoutFiles(start.job ?? {}), start.profile);
}

/** Does something with the next picture, however often it is asked for until then. */
function oncePerPicture(work: () => void): () => void {
  let isAsked = false;
  return () => {
    if (isAsked) return;
    isAsked = true;
    requestAnimationFrame(() => {
      isAsked = false;
      work();
    });
  };
}

/** Ends the server; the page has nobody to talk to then. */
async function quit(client: Client): Promise<void> {
  await client.json('/api/quit', {}).catch(() => undefined);
  turnAway('Aplomb Studio has ended. This page can be closed.');
}

/** The page of who has no right to be here, or finds nobody here. */
function turnAway(error: unknown): void {
  const sentence = error instanceof Error ? error.message : String(error);
  root.replaceChildren(h('main', {class: 'turned-away', role: 'alert'}, h('h1', {}, 'Aplomb Studio'), h('p', {}, sentence)));
  document.documentElement.dataset.theme = matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light';
}

async function begin(): Promise<void> {
  try {
    const token = await tokenOf(location.hash.slice(1)), client = new Client(token);
    history.replaceState(null, '', `#${token}`); // to be loaded again
    build(client, await client.json<Start>('/api/start'));
  } catch (error) {
    turnAway(error);
  }
}

addEventListener('hashchange', () => location.reload());
void begin();

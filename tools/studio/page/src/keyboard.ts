import {type Focused, isTyped, keepsKey, toolKeys} from './keys';
import {withHandles} from './state/job';
import type {Look, ToolName} from './state/ui';
import type {Toolbox} from './tools/toolbox';
import type {Bench} from './tools/tool';

interface Actions {
  readonly make: () => void;
  readonly open: () => void;
  readonly save: () => void;
  readonly help: () => void;
}

/** The keyboard, except where something is being typed. */
export function listenToKeys(bench: Bench, toolbox: Toolbox, actions: Actions): void {
  addEventListener('keydown', (event) => {
    const target = event.target as HTMLElement, isTyping = isTyped(target as Focused);
    if (document.querySelector('dialog[open]')) return;
    if (event.key === 'Escape') return escape(bench, toolbox, target, isTyping);
    const done = event.ctrlKey || event.metaKey ? command(bench, actions, event, isTyping)
                                                : !event.altKey && !keepsKey(target as Focused, event.key) && plain(bench, actions, event);
    if (done) event.preventDefault();
  });
}

/** First leaves a field, then the tool, then the fall, then the run. */
function escape(bench: Bench, toolbox: Toolbox, target: HTMLElement, isTyping: boolean): void {
  if (isTyping) target.blur();
  else if (bench.view.falls) bench.view.stopFall();
  else if (!toolbox.cancel()) bench.conductor.cancel();
}

function command(bench: Bench, actions: Actions, event: KeyboardEvent, isTyping: boolean): boolean {
  const {documents, results} = bench;
  switch (event.key.toLowerCase()) {
    case 'z':
      if (isTyping && !(event.target as HTMLInputElement).readOnly && !event.shiftKey) (event.target as HTMLElement).blur();
      if (event.shiftKey) documents.redo();
      else documents.undo();
      return true;
    case 'y':
      documents.redo();
      return true;
    case 'enter':
      if (documents.doc.model && !results.value.busy) actions.make();
      return true;
    case 'o':
      actions.open();
      return true;
    case 's':
      actions.save();
      return true;
    default:
      return false;
  }
}

function plain({ui, view, documents}: Bench, actions: Actions, event: KeyboardEvent): boolean {
  const tool = (Object.keys(toolKeys) as ToolName[]).find((name) => toolKeys[name].toLowerCase() === event.key.toLowerCase());
  if (tool && !event.shiftKey && documents.doc.model) return ui.patch({tool}), true;
  const look = ({1: 'solid', 2: 'xray', 3: 'section'} as Record<string, Look>)[event.key];
  if (look) return ui.patch({look}), true;
  switch (event.key) {
    case ' ':
      view.fall();
      return true;
    case '0':
      view.lookFrom('corner');
      return true;
    case '?':
      actions.help();
      return true;
    case '[':
    case ']':
      ui.patch({brushPercent: Math.min(40, Math.max(1, ui.value.brushPercent + (event.key === ']' ? 1 : -1)))});
      return true;
    case 'Delete':
      return dropHandle(ui, documents);
    default:
      return nudge(ui, documents, event.key, event.shiftKey) || orbit(view, event.key, event.shiftKey);
  }
}

function dropHandle(ui: Bench['ui'], documents: Bench['documents']): boolean {
  const index = ui.value.handle, {job} = documents.doc;
  if (index === null || ui.value.tool !== 'handle') return false;
  ui.patch({handle: null});
  documents.change(withHandles(job, (job.handles ?? []).filter((_, at) => at !== index)), 'remove a handle');
  return true;
}

const ways: Record<string, readonly [number, number, number]> = {
  ArrowRight: [1, 0, 0], ArrowLeft: [-1, 0, 0], ArrowUp: [0, 1, 0], ArrowDown: [0, -1, 0], PageUp: [0, 0, 1], PageDown: [0, 0, -1],
};

/** The eye goes where the arrow points, by 15 degrees, or with Shift by 3. */
function orbit(view: Bench['view'], key: string, isFine: boolean): boolean {
  const way = ways[key], step = isFine ? 3 : 15;
  if (!way || way[2] !== 0) return false;
  view.stage.orbit(step * way[0], step * way[1]);
  return true;
}

/** A millimetre, or with Shift a tenth. */
function nudge(ui: Bench['ui'], documents: Bench['documents'], key: string, isFine: boolean): boolean {
  const way = ways[key], index = ui.value.handle, {job} = documents.doc, handle = job.handles?.[index ?? -1];
  if (!way || !handle || ui.value.tool !== 'handle') return false;
  const from = handle.to_mm ?? handle.at_mm, step = isFine ? 0.1 : 1;
  const to_mm = [0, 1, 2].map((axis) => Math.round((from[axis]! + step * way[axis]!) * 100) / 100) as unknown as typeof from;
  documents.change(withHandles(job, job.handles!.map((one, at) => (at === index ? {...one, to_mm} : one))), 'move a handle');
  return true;
}

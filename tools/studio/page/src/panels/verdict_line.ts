import type {Bench} from '../tools/tool';
import {isUnanswered} from '../results/results';
import {type Tone, heldPoses, verdictOf} from '../results/verdict';
import {h, icon, say} from './dom';
import type {Part} from './fields';
import {icons} from './icons';

const pictures: Record<Tone, keyof typeof icons> = {falls: 'falls', short: 'short', stands: 'stands', none: 'wait'};

/** The verdict: one line, always of what is shown now, read out when it changes. */
export function verdictLine({documents, results, ui, conductor}: Bench): Part {
  const line = h('h1', {class: 'verdict-line', id: 'verdict', role: 'status', 'aria-live': 'polite'});
  const detail = h('p', {class: 'verdict-detail', id: 'verdict-detail'});
  const picture = h('span', {class: 'verdict-picture'});
  const element = h('div', {class: 'verdict'}, picture, h('div', {}, line, detail));
  let shown: Tone | null = null;
  const update = () => {
    const {asked} = documents, now = results.value;
    element.hidden = asked.model === null && now.busy === null;
    const isComing = conductor.answering;
    const verdict = verdictOf(now, asked, ui.value.pose, isComing);
    if (verdict.line === '' && isComing && documents.state.value.wish) return;
    const held = heldPoses(now, asked, isComing);
    const others = held && held.all > 1 ? `; ${held.held} of ${held.all} poses hold` : '';
    say(line, verdict.line || waiting(isUnanswered(now, asked), now.busy?.stage));
    say(detail, verdict.line ? verdict.detail + others : '');
    element.dataset.tone = verdict.tone;
    if (shown !== verdict.tone) picture.replaceChildren(icon(icons[pictures[verdict.tone]]));
    shown = verdict.tone;
  };
  return {element, update};
}

function waiting(failed: boolean, stage: string | undefined): string {
  if (stage) return `${stage}\u2026`;
  return failed ? 'No verdict' : 'Weighing\u2026';
}

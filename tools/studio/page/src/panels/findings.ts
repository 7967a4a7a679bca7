import type {Bench} from '../tools/tool';
import {freshStand, shownJudgement} from '../results/results';
import {numbered} from '../view/finding_marks';
import type {Judgement} from '../results/report';
import {h} from './dom';
import type {Part} from './fields';

const words = {fail: 'fails', warn: 'warning', info: 'for information'} as const;

/** How it prints: what the judge found, with marks in the scene. */
export function findingsPanel({documents, results, ui, conductor}: Bench): Part {
  const said = h('p', {class: 'prints', role: 'status'}), list = h('ol', {class: 'findings'});
  const ask = h('button', {class: 'plain', id: 'judge', onclick: () =>
    void conductor.runs.validate(freshStand(results.value, documents.doc) ? 'result' : 'model')}, 'Judge how it prints');
  const element = h('details', {open: true, class: 'section'}, h('summary', {}, 'Printing'), said, list, ask);
  let shown: Judgement | null = null;
  const update = () => {
    const found = shownJudgement(results.value, documents.doc), judgement = found?.judgement ?? null;
    ask.hidden = found !== null;
    ask.disabled = results.value.busy !== null || documents.doc.model === null;
    said.hidden = judgement === null;
    if (judgement !== shown) {
      said.textContent = judgement ? summary(judgement, found!.of) : '';
      said.dataset.tone = judgement?.passes ? 'stands' : judgement && found && isInherited(judgement, found.of) ? 'short' : 'falls';
      list.replaceChildren(...(judgement ? numbered(judgement) : []).map(({finding, number}) =>
        h('li', {class: finding.severity, 'data-number': number}, h('button', {
          'aria-pressed': false, onclick: () => ui.patch({finding: ui.value.finding === number ? null : number}),
        }, h('span', {class: `badge ${finding.severity}`}, String(number)),
          h('span', {}, h('strong', {}, `${words[finding.severity]}: `), finding.text)),
        finding.remedy ? h('p', {class: 'remedy'}, finding.remedy) : null)));
      shown = judgement;
      ui.patch({finding: null}); // its number was of the other judgement
    }
    for (const item of list.children as HTMLCollectionOf<HTMLElement>) {
      const isIt = Number(item.dataset.number) === ui.value.finding;
      const isNew = isIt && !item.classList.contains('open');
      item.classList.toggle('open', isIt);
      if (isNew) item.scrollIntoView({block: 'nearest'});
      item.querySelector('button')!.setAttribute('aria-pressed', String(isIt));
    }
  };
  return {element, update};
}

/** Whether a result fails nothing that the model as it came does not fail, too: with ballast the mesh is the same. */
function isInherited(judgement: Judgement, of: 'model' | 'result'): boolean {
  return of === 'result' && judgement.new_failures?.length === 0;
}

function summary(judgement: Judgement, of: 'model' | 'result'): string {
  const fails = judgement.checks.filter((check) => check.verdict.startsWith('fail')).length;
  const checks = `${fails} ${fails === 1 ? 'check fails' : 'checks fail'}`;
  if (!judgement.passes && isInherited(judgement, of)) return `By itself (${judgement.process}) ${checks}, as for the model as it came.`;
  const what = of === 'model' ? 'The model as it came' : 'What was made';
  return judgement.passes ? `${what} prints (${judgement.process}).`
    : `${what} will not print as it is (${judgement.process}): ${checks}.`;
}

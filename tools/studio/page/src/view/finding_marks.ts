import {Vector3} from 'three';

import type {Finding, Judgement} from '../results/report';
import type {UiStore} from '../state/ui';
import type {Figure} from './figure';
import type {Labels} from './labels';

/** Findings that have a place, with their numbers in the list. */
export function numbered(judgement: Judgement): {finding: Finding; number: number}[] {
  const order = {fail: 0, warn: 1, info: 2};
  return [...judgement.findings].sort((a, b) => order[a.severity] - order[b.severity])
    .map((finding, index) => ({finding, number: index + 1}));
}

/** Numbered marks beside where findings are; a press on one shows it in the list. */
export class FindingMarks {
  #buttons: {button: HTMLButtonElement; at: Vector3}[] = []; // in placed coordinates
  #shown: Judgement | null = null;

  constructor(private readonly labels: Labels, private readonly figure: Figure, private readonly ui: UiStore) {}

  show(judgement: Judgement | null): void {
    if (judgement !== this.#shown) this.#make(judgement);
    for (const {button, at} of this.#buttons) {
      button.setAttribute('aria-pressed', String(this.ui.value.finding === Number(button.textContent)));
      this.labels.putBeside(button, at.clone().applyMatrix4(this.figure.pose.matrixWorld));
    }
  }

  #make(judgement: Judgement | null): void {
    for (const {button} of this.#buttons) this.labels.remove(button);
    this.#shown = judgement;
    this.#buttons = [];
    for (const {finding, number} of judgement ? numbered(judgement) : []) {
      if (!finding.at_mm || !finding.box_mm) continue;
      const button = document.createElement('button');
      button.className = `mark finding-mark ${finding.severity}`;
      button.textContent = String(number);
      button.title = finding.text;
      button.setAttribute('aria-label', `Finding ${number}: ${finding.text}`);
      button.onclick = () => this.ui.patch({finding: this.ui.value.finding === number ? null : number});
      this.#buttons.push({button, at: new Vector3(...finding.at_mm)});
    }
  }
}

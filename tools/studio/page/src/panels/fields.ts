import {h, newId} from './dom';

/** A part of a panel that can be brought up to date. */
export interface Part {
  readonly element: HTMLElement;
  update(): void;
}

interface NumberOptions {
  readonly label: string;
  readonly unit: string;
  readonly min?: number;
  readonly max?: number;
  readonly step: number;
  readonly hint?: string;
  readonly value: () => number | undefined;
  readonly standard: () => string; // shown where nothing is asked
  readonly change: (value: number | undefined) => void;
}

/** Shows text in an input. What is being typed there stays until the value itself is another, as after undo. */
export function shownIn(input: HTMLInputElement): (text: string) => void {
  let shown: string | null = null;
  return (text) => {
    if (text === shown && document.activeElement === input) return;
    if (input.value !== text) input.value = text;
    shown = text;
  };
}

/** A number with its unit; empty means the standard, which is shown in its place. */
export function numberField(options: NumberOptions): Part {
  const id = newId();
  const input = h('input', {
    id, type: 'number', inputMode: 'decimal', step: String(options.step), title: options.hint,
    min: options.min === undefined ? undefined : String(options.min), max: options.max === undefined ? undefined : String(options.max),
    onchange: () => options.change(input.value === '' ? undefined : Number(input.value)),
  });
  const show = shownIn(input);
  const element = h('div', {class: 'field'}, h('label', {for: id}, options.label),
                    h('span', {class: 'with-unit'}, input, h('span', {class: 'unit'}, options.unit)));
  return {
    element,
    update: () => {
      const value = options.value();
      show(value === undefined ? '' : String(Math.round(value * 1e4) / 1e4));
      input.placeholder = options.standard();
    },
  };
}

interface ChoiceOptions {
  readonly label: string;
  readonly hint?: string;
  readonly options: () => readonly (readonly [value: string, text: string])[];
  readonly value: () => string;
  readonly change: (value: string) => void;
}

/** One of a few. */
export function choiceField(options: ChoiceOptions): Part {
  const id = newId(), select = h('select', {id, title: options.hint, onchange: () => options.change(select.value)});
  let shown = '';
  return {
    element: h('div', {class: 'field'}, h('label', {for: id}, options.label), select),
    update: () => {
      const all = options.options(), key = JSON.stringify(all);
      if (key !== shown) select.replaceChildren(...all.map(([value, text]) => h('option', {value}, text)));
      shown = key;
      select.value = options.value();
    },
  };
}

/** Two fields in one row, under the label of the first. */
export function paired(first: Part, second: Part): Part {
  const [label, one] = first.element.children as unknown as [HTMLElement, HTMLElement];
  const [other, two] = second.element.children as unknown as [HTMLElement, HTMLElement];
  two.querySelector('input')?.setAttribute('aria-label', other.textContent ?? '');
  return {
    element: h('div', {class: 'field'}, label, h('span', {class: 'two'}, one, two)),
    update: () => [first, second].forEach((field) => field.update()),
  };
}

/** Three numbers in a row, such as a point or turns about x, y and z. */
export function tripleField(label: string, unit: string, step: number, value: () => readonly number[] | undefined,
                            change: (value: readonly [number, number, number]) => void): Part {
  const inputs = ['x', 'y', 'z'].map((axis) => h('input', {
    type: 'number', step: String(step), placeholder: '0', 'aria-label': `${label}, ${axis}, ${unit}`,
    onchange: () => change(inputs.map((input) => Number(input.value || 0)) as [number, number, number]),
  }));
  const shows = inputs.map(shownIn);
  return {
    element: h('div', {class: 'field triple', role: 'group', 'aria-label': label}, h('span', {class: 'label'}, label),
               h('span', {class: 'three'}, ...inputs.map((input, axis) =>
                 h('span', {class: 'with-unit'}, h('span', {class: 'axis', 'aria-hidden': 'true'}, 'xyz'[axis]!), input)),
                 h('span', {class: 'unit', 'aria-hidden': 'true'}, unit))),
    update: () => shows.forEach((show, axis) => {
      const number = value()?.[axis] ?? 0;
      show(number === 0 ? '' : String(Math.round(number * 100) / 100));
    }),
  };
}

/** A switch with a word. */
export function switchField(label: string, hint: string, value: () => boolean, change: (value: boolean) => void): Part {
  const input = h('input', {type: 'checkbox', title: hint, onchange: () => change(input.checked)});
  return {
    element: h('label', {class: 'switch', title: hint}, input, label),
    update: () => {
      input.checked = value();
    },
  };
}

/** A part of the panel that can be folded away. */
export function section(title: string, parts: readonly Part[], open = true): Part & {readonly element: HTMLDetailsElement} {
  const element = h('details', {open, class: 'section'}, h('summary', {}, title), ...parts.map((part) => part.element));
  return {element, update: () => parts.forEach((part) => part.update())};
}

type Child = Node | string | null | undefined | false;
type Props = Record<string, unknown>;

/** An element: `on...` are listeners, `class` and `aria-...` attributes, the rest properties. */
export function h<K extends keyof HTMLElementTagNameMap>(tag: K, props: Props = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [key, value] of Object.entries(props)) {
    if (value === undefined) continue;
    if (key.startsWith('on')) element.addEventListener(key.slice(2), value as EventListener);
    else if (key === 'class' || key === 'role' || key === 'for' || key.includes('-')) element.setAttribute(key, String(value));
    else (element as unknown as Props)[key] = value;
  }
  element.append(...children.filter((child): child is Node | string => child !== null && child !== undefined && child !== false));
  return element;
}

let ids = 0;

export function newId(): string {
  return `f${++ids}`;
}

/** A drawing of strokes in a square of 24, for what has a word beside it or a label. */
export function icon(path: string): SVGSVGElement {
  const name = 'http://www.w3.org/2000/svg';
  const svg = document.createElementNS(name, 'svg'), drawn = document.createElementNS(name, 'path');
  svg.setAttribute('viewBox', '0 0 24 24');
  svg.setAttribute('class', 'icon');
  svg.setAttribute('aria-hidden', 'true');
  drawn.setAttribute('d', path);
  svg.append(drawn);
  return svg;
}

/** Changes text only where it is another, so that it is read out no more than once. */
export function say(element: HTMLElement, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

/** A child that stays where it is while it is brought up to date. */
export interface Kept {
  readonly element: HTMLElement;
  update(): void;
}

/**
 * Keeps as many children in a parent as there are things to show, by their index. They stay where they are: a button that is
 * replaced between press and release is not pressed, and takes the focus with it.
 */
export function keeper(parent: HTMLElement, make: (index: number) => Kept): (count: number) => void {
  const all: Kept[] = [];
  return (count) => {
    while (all.length < count) parent.append(all[all.push(make(all.length)) - 1]!.element);
    const gone = all.splice(count), had = gone.some(({element}) => element.contains(document.activeElement));
    for (const {element} of gone) element.remove();
    for (const one of all) one.update();
    if (had) focusable(all.at(-1)?.element)?.focus();
  };
}

function focusable(element: HTMLElement | undefined): HTMLElement | null {
  return element?.matches('button') ? element : element?.querySelector('button') ?? null;
}

/** Makes a toolbar one stop of the Tab key, in which the arrow keys go on. \return what is to be called after each update. */
export function asToolbar(toolbar: HTMLElement): () => void {
  const buttons = () => [...toolbar.querySelectorAll('button')].filter((one) => !one.disabled && !one.closest('[hidden]'));
  let stop: HTMLElement | null = null;
  const update = () => {
    const all = buttons();
    if (!stop || !all.includes(stop as HTMLButtonElement)) stop = all.find((one) => one.ariaPressed === 'true') ?? all[0] ?? null;
    for (const one of all) one.tabIndex = one === stop ? 0 : -1;
  };
  toolbar.addEventListener('focusin', ({target}) => {
    if (target instanceof HTMLButtonElement) stop = target;
    update();
  });
  toolbar.addEventListener('keydown', (event) => {
    const step = ['ArrowRight', 'ArrowDown'].includes(event.key) ? 1 : ['ArrowLeft', 'ArrowUp'].includes(event.key) ? -1 : 0;
    if (!step || !(event.target instanceof HTMLButtonElement)) return;
    const all = buttons();
    all[(all.indexOf(event.target) + step + all.length) % all.length]?.focus();
    event.preventDefault();
  });
  return update;
}

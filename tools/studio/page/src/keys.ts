import type {ToolName} from './state/ui';

export const toolKeys: Readonly<Record<ToolName, string>> = {look: 'V', face: 'F', turn: 'R', touch: 'C', handle: 'H', lock: 'L'};

/** What the help shows. */
export const keyList: readonly (readonly [string, string])[] = [
  ['Ctrl Enter', 'make it stand'], ['Ctrl Z', 'undo'], ['Ctrl Shift Z', 'redo'], ['Escape', 'cancel tool, then run'],
  ['V F R C H L', 'tools, from the top'], ['1 2 3', 'solid, see through, cut'], ['Space', 'let it fall'], ['0', 'show all of it'],
  ['[ ]', 'smaller, larger brush'], ['Arrows', 'go round it'],
  ['Arrows, PgUp, PgDn', 'move the handle in hand'], ['Delete', 'take the handle away'],
  ['Ctrl O', 'open'], ['Ctrl S', 'save 3MF'], ['?', 'this list'],
];

/** What has the focus, as far as it wants keys for itself. */
export interface Focused {
  readonly tagName: string;
  readonly type?: string; // of an input
  readonly role?: string | null;
}

const pressed = ['checkbox', 'radio', 'button', 'submit', 'file', 'color'], onSliders = /^(Arrow.*|Page.*|Home|End)$/;

/** Whether letters go into it. */
export function isTyped({tagName, type}: Focused): boolean {
  return tagName === 'SELECT' || tagName === 'TEXTAREA' || (tagName === 'INPUT' && type !== 'range' && !pressed.includes(type ?? ''));
}

/** Whether a key without Ctrl is for what has the focus, and none of the page's. */
export function keepsKey(focused: Focused, key: string): boolean {
  if (isTyped(focused)) return true;
  if (focused.tagName === 'INPUT' && focused.type === 'range') return onSliders.test(key);
  const isButton = ['BUTTON', 'SUMMARY', 'INPUT'].includes(focused.tagName) || focused.role === 'tab';
  return isButton && (key === ' ' || key === 'Enter' || onSliders.test(key));
}

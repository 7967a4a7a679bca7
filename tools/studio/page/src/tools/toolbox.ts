import type {ToolName} from '../state/ui';
import {HandleTool} from './handle_tool';
import {LayOnFace} from './lay_on_face';
import {LockBrush} from './lock_brush';
import {TouchTool} from './touch_tool';
import type {Bench, Tool} from './tool';
import {TurnTool} from './turn_tool';

/** Gives what the pointer does to the tool in hand, before the camera has it. */
export class Toolbox {
  readonly tools: Readonly<Record<ToolName, Tool>>;
  #pressed: number | null = null; // the pointer that is down

  constructor(private readonly bench: Bench) {
    this.tools = {
      look: {hint: 'Drag to look around, wheel to come nearer, right button to shift.'},
      face: new LayOnFace(bench),
      turn: new TurnTool(bench),
      touch: new TouchTool(bench),
      handle: new HandleTool(bench),
      lock: new LockBrush(bench),
    };
    bench.ui.subscribe((ui, before) => {
      if (ui.tool === before.tool) return;
      this.tools[before.tool].cancel?.();
      this.tools[before.tool].end?.();
      this.tools[ui.tool].begin?.();
      bench.view.stage.invalidate();
    });
    this.#listen(bench.view.stage.canvas);
  }

  get tool(): Tool {
    return this.tools[this.bench.ui.value.tool];
  }

  /** Takes back what is being done, else lays the tool down. \return whether there was anything. */
  cancel(): boolean {
    if (this.tool.cancel?.()) {
      this.#pressed = null;
      return true;
    }
    if (this.bench.ui.value.tool === 'look') return false;
    this.bench.ui.patch({tool: 'look'});
    return true;
  }

  #listen(canvas: HTMLCanvasElement): void {
    const room = canvas.parentElement as HTMLElement;
    room.addEventListener('pointerdown', (event) => {
      if (event.target !== canvas || event.button !== 0 || this.#pressed !== null) return;
      this.bench.view.stopFall();
      if (!this.tool.down?.(event.clientX, event.clientY, event)) return;
      event.stopPropagation();
      event.preventDefault();
      (document.activeElement as HTMLElement | null)?.blur(); // as any press would: the keys are the tool's from here on
      this.#pressed = event.pointerId;
      canvas.setPointerCapture(event.pointerId);
    }, {capture: true});
    canvas.addEventListener('pointermove', (event) => {
      if (this.#pressed === event.pointerId) this.tool.drag?.(event.clientX, event.clientY, event);
      else if (this.#pressed === null && event.buttons === 0) this.tool.hover?.(event.clientX, event.clientY);
    });
    const released = (event: PointerEvent, done: () => void) => {
      if (this.#pressed !== event.pointerId) return;
      this.#pressed = null;
      done();
    };
    canvas.addEventListener('pointerup', (event) => released(event, () => this.tool.up?.(event.clientX, event.clientY, event)));
    canvas.addEventListener('pointercancel', (event) => released(event, () => this.tool.cancel?.())); // it is nowhere
  }
}

import {type Ball, type Vec3, edited, mostBalls} from '../state/job';
import {locked, paintBall} from '../view/paint';
import {type Bench, type Tool, brushOf, tenth} from './tool';

/** Paints what is to stay where it is: a row of balls along the stroke. With Alt it rubs out. */
export class LockBrush implements Tool {
  readonly hint = 'Paint what is to stay as it is when the figure bends. Alt: rub out.';
  #stroke: Ball[] | null = null;
  #rubs = false;

  constructor(private readonly bench: Bench) {}

  down(x: number, y: number, event: PointerEvent): boolean {
    if (!this.bench.view.picker.at(x, y)) return false;
    this.#stroke = [...(this.bench.documents.doc.job.lock ?? [])];
    this.#rubs = event.altKey;
    this.#touch(x, y);
    return true;
  }

  drag(x: number, y: number): void {
    this.#touch(x, y);
  }

  up(): void {
    const stroke = this.#stroke;
    this.#stroke = null;
    if (stroke) this.bench.documents.change(edited(this.bench.documents.doc.job, {lock: stroke}), this.#rubs ? 'unlock' : 'lock');
  }

  cancel(): boolean {
    const held = this.#stroke !== null;
    this.#stroke = null;
    this.bench.view.paintAnew();
    return held;
  }

  #touch(x: number, y: number): void {
    const hit = this.bench.view.picker.at(x, y), surface = this.bench.view.figure.outside, radius_mm = brushOf(this.bench);
    if (!hit || !surface || !this.#stroke) return;
    const far = (ball: Ball) => Math.hypot(...ball.at_mm.map((value, axis) => value - hit.placed[axis]!));
    if (this.#rubs) {
      const left = this.#stroke.filter((ball) => far(ball) > Math.max(radius_mm, ball.radius_mm));
      if (left.length === this.#stroke.length) return;
      this.#stroke = left;
      surface.paint.fill(0);
      for (const ball of left) paintBall(surface, ball.at_mm, ball.radius_mm, locked);
    } else {
      // Balls a little more than half their radius apart cover the stroke without a rim.
      if (this.#stroke.length >= mostBalls || this.#stroke.some((ball) => far(ball) < 0.6 * ball.radius_mm)) return;
      this.#stroke = [...this.#stroke, {at_mm: hit.placed.map(tenth) as unknown as Vec3, radius_mm}];
      paintBall(surface, hit.placed, radius_mm, locked);
    }
    surface.painted();
    this.bench.view.stage.invalidate();
  }
}

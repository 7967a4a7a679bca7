import type {Handle, Vec3} from '../state/job';
import type {Hit} from '../view/pick';

/** The handle that a press means, by its index, or -1: the one that holds what is pressed, else the one that is to come there. */
export function handleAt(handles: readonly Handle[], {placed, shown}: Pick<Hit, 'placed' | 'shown'>): number {
  const holds = handles.findIndex((one) => isNear(placed, one.at_mm, one));
  return holds >= 0 ? holds : handles.findIndex((one) => isNear(shown, one.to_mm ?? one.at_mm, one));
}

function isNear(at: Vec3, middle: Vec3, {radius_mm}: Handle): boolean {
  return Math.hypot(at[0] - middle[0], at[1] - middle[1], at[2] - middle[2]) <= (radius_mm ?? 0) + 1;
}

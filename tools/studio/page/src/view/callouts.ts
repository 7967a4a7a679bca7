/** A place of the room, in pixels from its top left corner. */
export interface Place {
  readonly x: number;
  readonly y: number;
}

interface Box {
  readonly left: number;
  readonly top: number;
  readonly right: number;
  readonly bottom: number;
}

/** What marks must keep off: the edge of the room with what floats there, and middles of what is as large as `keep_px` each way. */
export interface Room {
  readonly free: Box;
  readonly taken: readonly Place[];
}

const apart_px = 30; // of the middles of two marks: each is 22 wide, and has a ring when it is chosen
const keep_px = {x: 40, y: 26};
const offPoint_px = 20; // of a mark and a point that a mark speaks of
const ways = 16, lengths_px = [44, 62, 86, 114, 146, 184];

/**
 * Places marks beside the points that they speak of, such that none lies on another, on a point or on what is taken: each as near to
 * its point as it can be, below it if that is as good. One that still fits where it was (`last`, from its point) stays there, so
 * that marks do not jump about while one looks around.
 */
export function besides(points: readonly Place[], last: readonly (Place | undefined)[], {free, taken}: Room): Place[] {
  const placed: Place[] = [];
  points.forEach((point, index) => {
    const fits = (at: Place) => at.x >= free.left && at.x <= free.right && at.y >= free.top && at.y <= free.bottom &&
      placed.every((one) => distance(one, at) >= apart_px) && points.every((one) => distance(one, at) >= offPoint_px) &&
      taken.every((one) => Math.abs(one.x - at.x) >= keep_px.x || Math.abs(one.y - at.y) >= keep_px.y);
    const old = last[index], was = old && {x: point.x + old.x, y: point.y + old.y};
    placed.push(was && fits(was) ? was : candidates(point).find(fits) ?? nearest(point, free));
  });
  return placed;
}

/** From below to both sides and up, then farther away. */
function candidates(point: Place): Place[] {
  return lengths_px.flatMap((length) => Array.from({length: ways}, (_, n) => {
    const angle = Math.PI / 2 + (n % 2 ? 1 : -1) * Math.ceil(n / 2) * ((2 * Math.PI) / ways);
    return {x: point.x + length * Math.cos(angle), y: point.y + length * Math.sin(angle)};
  }));
}

function nearest({x, y}: Place, {left, top, right, bottom}: Box): Place {
  return {x: Math.max(left, Math.min(right, x)), y: Math.max(top, Math.min(bottom, y))};
}

const distance = (a: Place, b: Place) => Math.hypot(a.x - b.x, a.y - b.y);

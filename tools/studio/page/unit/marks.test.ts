// What is drawn about the model: how it falls, the ring, marks beside their points, the outline of a cut.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {test} from 'node:test';

import {Plane, Vector3} from 'three';

import {type Place, besides} from '../src/view/callouts';
import {fallenBy} from '../src/view/fall';
import {barEnd} from '../src/view/ground_marks';
import {facesOf, outlineOf} from '../src/view/outline';
import {Surface} from '../src/view/surface';

test('it is tilted to its tip angle, then falls faster and faster, and then it is over', () => {
  const at = (since: number) => fallenBy(1.2, 0.2, since, false);
  const turns = Array.from({length: 37}, (_, n) => at(100 * n)!);
  assert.equal(turns[0], 0);
  assert.ok(Math.abs(at(1400)! - 0.2) < 1e-9);
  assert.ok(turns.every((turn, n) => n === 0 || turn >= turns[n - 1]!), String(turns));
  assert.equal(turns.at(-1), 1.2);
  assert.equal(at(3700), null);
});

test('where motion is unwelcome it does not move: it is tilted, then fallen', () => {
  for (const [first, pictures] of [[0.2, [0.2, 1.2]], [0, [1.2]]] as const) {
    const turns = new Set<number>();
    for (let since = 0, turn; (turn = fallenBy(1.2, first, since, true)) !== null; since += 16) turns.add(turn);
    assert.deepEqual([...turns], pictures);
  }
});

test('a bar of the ring is longer where the angle is larger, and never too short to be seen where it falls', () => {
  assert.ok(barEnd(3) > barEnd(1) && barEnd(10) > barEnd(3) && barEnd(80) === barEnd(45));
  assert.ok(barEnd(-10) < barEnd(-5) && barEnd(-0.01) < 0.94);
  assert.equal(barEnd(0), 1);
});

const free = {left: 100, top: 50, right: 900, bottom: 600};
const apart = (a: Place, b: Place) => Math.hypot(a.x - b.x, a.y - b.y);

test('marks of the same point, or of points side by side, lie apart and beside them', () => {
  const points = [[500, 400], [500, 400], [500, 400], [510, 395], [505, 420]].map(([x, y]) => ({x: x!, y: y!}));
  const places = besides(points, [], {free, taken: [{x: 520, y: 450}]});
  places.forEach((place, i) => {
    assert.ok(points.every((point) => apart(place, point) >= 20));
    assert.ok(places.every((other, k) => k === i || apart(place, other) >= 30));
    assert.ok(Math.abs(place.x - 520) >= 40 || Math.abs(place.y - 450) >= 26);
  });
});

test('a mark stays where it was beside its point while that is free, and in the room', () => {
  const [first] = besides([{x: 500, y: 400}], [], {free, taken: []}), off = {x: first!.x - 500, y: first!.y - 400};
  assert.deepEqual(besides([{x: 500, y: 300}], [off], {free, taken: []}), [{x: 500 + off.x, y: 300 + off.y}]);
  const [low] = besides([{x: 500, y: 599}], [off], {free, taken: []});
  assert.ok(low!.y <= free.bottom);
});

/** A cube from 0 to 2. */
const cube = () => new Surface({
  name: 'cube', positions: new Float32Array([0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 0, 0, 2, 2, 0, 2, 2, 2, 2, 0, 2, 2]),
  triangles: new Uint32Array([0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4, 1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7]),
});

test('the outline of a cut goes once around, on the plane', () => {
  const ends = outlineOf(cube(), new Plane(new Vector3(0, 0, 1), -0.5));
  let length = 0;
  for (let i = 0; i < ends.length; i += 6) {
    assert.ok(Math.abs(ends[i + 2]! - 0.5) < 1e-6 && Math.abs(ends[i + 5]! - 0.5) < 1e-6);
    length += Math.hypot(ends[i + 3]! - ends[i]!, ends[i + 4]! - ends[i + 1]!);
  }
  assert.ok(Math.abs(length - 8) < 1e-6, String(length));
  assert.equal(outlineOf(cube(), new Plane(new Vector3(0, 0, 1), -3)).length, 0);
});

test('the faces of a convex surface are its half-spaces', () => {
  const faces = facesOf(cube()), inside = (x: number, y: number, z: number) =>
    faces.every(([a, b, c, d]) => a! * x + b! * y + c! * z + d! >= -1e-9);
  assert.equal(faces.length, 6);
  assert.ok(inside(1, 1, 1) && inside(0, 2, 1) && !inside(2.1, 1, 1) && !inside(1, 1, -0.1));
});

/** The relative luminance of WCAG 2. */
function luminance(hex: string): number {
  const [r, g, b] = [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255)
    .map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4)) as [number, number, number];
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

test('in both themes what is drawn can be told from what it is drawn on: 3 to 1, text 4.5 to 1', () => {
  const [light, dark] = readFileSync('src/style/palette.css', 'utf8').split('[data-theme="dark"]').map((theme) =>
    Object.fromEntries([...theme.matchAll(/--([\w-]+): (#\w{6});/g)].map(([, name, color]) => [name, luminance(color!)])));
  const pairs: [number, string, string][] = [
    ...['mark', 'accent', 'good', 'bad', 'mild', 'ink'].map((name): [number, string, string] => [3, name, 'model']),
    ...['accent', 'good', 'bad', 'mild', 'ink'].flatMap((name): [number, string, string][] => [[4.5, name, 'plate'], [4.5, name, 'paper']]),
    [3, 'cut-line', 'cut'], [3, 'dense', 'cut'], [3, 'edge', 'paper'], [3, 'edge', 'field'], [4.5, 'soft', 'paper'], [4.5, 'on-accent', 'accent'],
  ];
  for (const theme of [light!, dark!])
    for (const [least, a, b] of pairs) {
      const [low, high] = [theme[a]!, theme[b]!].sort((one, other) => one - other) as [number, number];
      assert.ok((high + 0.05) / (low + 0.05) >= least, `${a} on ${b}: ${((high + 0.05) / (low + 0.05)).toFixed(2)}`);
    }
});

import assert from 'node:assert/strict';
import {test} from 'node:test';

import {BoxGeometry, Group, Mesh, PerspectiveCamera, Plane, Vector3} from 'three';

import {handleAt} from '../src/tools/handle_at';
import type {Figure} from '../src/view/figure';
import {Picker} from '../src/view/pick';
import type {Stage} from '../src/view/stage';
import {Surface} from '../src/view/surface';

/** Two cubes of 2 mm, the one behind the other as seen from the front, where the camera is: at y = -5 and y = 5. */
function scene(cutAt: number | null) {
  const boxes = [-5, 5].map((y) => new BoxGeometry(2, 2, 2).translate(0, y, 0).toNonIndexed());
  const points = new Float32Array(boxes.flatMap((box) => [...box.getAttribute('position').array]));
  const outside = new Surface({name: 'model', positions: points, triangles: Uint32Array.from(points.subarray(points.length / 3 * 2), (_, i) => i)});
  const camera = new PerspectiveCamera(28, 1, 1, 1000), cap = new Mesh();
  camera.position.set(0, -50, 0);
  camera.lookAt(0, 0, 0);
  camera.updateMatrixWorld();
  cap.visible = cutAt !== null;
  const canvas = {getBoundingClientRect: () => ({left: 0, top: 0, width: 100, height: 100})};
  const figure = {outside, pose: new Group(), caps: new Group().add(cap), section: {plane: new Plane(new Vector3(0, 1, 0), -(cutAt ?? 0))}};
  return new Picker({camera, canvas} as unknown as Stage, figure as unknown as Figure);
}

const depth = (cutAt: number | null) => scene(cutAt).at(50, 50)?.placed[1];

test('a press is on the first surface that is seen: of a cut figure on the side that is left', () => {
  assert.equal(depth(null), -6);
  assert.equal(depth(-8), -6);
  assert.equal(depth(0), 4);
  assert.equal(depth(8), undefined);
});

test('a press on the face of a cut is on no surface', () => {
  assert.equal(depth(-5), undefined);
  assert.equal(depth(5), undefined);
});

test('a handle that was moved is taken where it went, where it is to go, and no more where it was', () => {
  const handles = [{at_mm: [0, 0, 9], radius_mm: 1, to_mm: [8, 0, 9]}, {at_mm: [0, 0, 0], radius_mm: 1}] as const;
  assert.equal(handleAt(handles, {placed: [0, 0, 9], shown: [5, 0, 9]}), 0);
  assert.equal(handleAt(handles, {placed: [3, 0, 9], shown: [8, 0, 9]}), 0);
  assert.equal(handleAt(handles, {placed: [-5, 0, 9], shown: [0, 0, 9]}), -1);
  assert.equal(handleAt(handles, {placed: [0, 0, 1], shown: [0, 0, 1]}), 1);
});

import assert from 'node:assert/strict';
import {test} from 'node:test';

import {Vector3} from 'three';

import {DocumentStore} from '../src/state/document';
import {done, redone, started, undone} from '../src/state/history';
import {type Job, bends, edited, placeKey, withHandles, withPlace, withStand} from '../src/state/job';
import {carried, degreesOf, rotationOf, turnOntoPlate, turnedFurther, upMatrix} from '../src/state/placement';

const model = {id: 1, name: 'a.stl', bytes: 1};

test('undo and redo give back each value, and a new one forgets what was undone', () => {
  const all = ['b', 'c', 'd'].reduce((history, value) => done(history, value, value), started('a'));
  const back = undone(undone(all));
  assert.equal(back.present.value, 'b');
  assert.equal(redone(back).present.value, 'c');
  assert.equal(redone(done(back, 'x', 'x')).present.value, 'x');
  assert.equal(undone(undone(undone(undone(all)))).present.value, 'a');
});

test('a profile is a step that can be undone, and without one nothing asks for ballast', () => {
  const store = new DocumentStore(), profile = {id: 2, name: 'a.ini', bytes: 1};
  store.open(model);
  store.slice(profile);
  store.change({ballast: 'only'}, 'ballast');
  store.slice(null);
  assert.deepEqual([store.doc.profile, store.doc.job], [null, {}]);
  store.undo();
  assert.deepEqual([store.doc.profile, store.doc.job], [profile, {ballast: 'only'}]);
  store.undo();
  store.undo();
  assert.equal(store.doc.profile, null);
});

test('a drag is one step however many wishes it had, and one that changes nothing is none', () => {
  const store = new DocumentStore();
  store.open(model);
  for (const wall_mm of [1, 2, 3]) store.hold({wall_mm});
  assert.equal(store.job.wall_mm, 3);
  assert.equal(store.doc.job.wall_mm, undefined);
  store.change({wall_mm: 3}, 'wall');
  store.change({wall_mm: 3}, 'wall');
  store.undo();
  assert.equal(store.doc.job.wall_mm, undefined);
  assert.ok(!store.canUndo, 'not before the model');
});

test('work is what was done beyond opening, whatever was undone', () => {
  const store = new DocumentStore();
  store.open(model);
  store.open({...model, id: 2});
  assert.ok(!store.hasWork);
  store.change({wall_mm: 2}, 'wall');
  assert.ok(store.hasWork);
  store.undo();
  assert.ok(!store.hasWork);
});

test('a job that is taken as a whole keeps its points, which are of its own placement', () => {
  const store = new DocumentStore(), job: Job = {place: {up: 'y'}, lock: [{at_mm: [1, 2, 3], radius_mm: 1}]};
  store.open(model);
  store.adopt(job);
  assert.deepEqual([store.doc.job, store.doc.frame], [job, placeKey(job)]);
});

test('a standard is not written into the job', () => {
  assert.deepEqual(edited<Job>({wall_mm: 2, lock: []}, {wall_mm: undefined}), {});
  assert.deepEqual(withPlace({place: {height_mm: 5}}, {height_mm: undefined}), {});
  assert.deepEqual(withStand({poses: [{stand: {tip_deg: 5}}]}, 0, {tip_deg: undefined}), {poses: [{stand: {}}]});
});

test('a handle allows the outside to move, as a job must', () => {
  const job = withHandles({}, [{at_mm: [0, 0, 1]}]);
  assert.equal(job.deform, 'auto');
  assert.equal(withHandles({deform: 'only'}, [{at_mm: [0, 0, 1]}]).deform, 'only');
  assert.ok(!bends(job));
  assert.ok(bends(withHandles({}, [{at_mm: [0, 0, 1], to_mm: [0, 1, 1]}])));
});

test('turns about x, y and z come back from their rotation', () => {
  for (const degrees of [[10, 20, 30], [-170, 45, 90], [0, 0, 0], [90, 0, -90]] as const)
    degreesOf(rotationOf(degrees)).forEach((value, axis) => assert.ok(Math.abs(value - degrees[axis]!) < 1e-5));
});

test('a face that is laid on the plate faces down, whatever the placement was', () => {
  for (const [up, rotate] of [[undefined, [0, 0, 0]], ['y', [10, 20, 30]], ['-x', [0, 170, 5]]] as const) {
    const job: Job = {place: {up, rotate_deg: rotate}}, inFile = new Vector3(0.3, -0.5, 0.8).normalize();
    const seen = inFile.clone().applyMatrix4(upMatrix(up)).applyMatrix4(rotationOf(rotate));
    const turned = turnedFurther(job, turnOntoPlate(seen));
    const now = inFile.clone().applyMatrix4(upMatrix(up)).applyMatrix4(rotationOf(turned));
    assert.ok(now.distanceTo(new Vector3(0, 0, -1)) < 1e-6, String(up));
  }
});

test('points are carried along when the placement changes, and back again', () => {
  const job: Job = {
    lock: [{at_mm: [1, 2, 3], radius_mm: 4}], handles: [{at_mm: [5, 6, 7], radius_mm: 1, to_mm: [5, 6, 9], turn_deg: [0, 0, 30]}],
    poses: [{stand: {contacts: [{at_mm: [0, 1, 0]}]}}, {hang: {from_mm: [[1, 1, 9]], up: 'x'}}],
  };
  const change = rotationOf([90, 0, 0]).scale(new Vector3(2, 2, 2)).setPosition(0, 0, 10);
  const there = carried(job, change);
  assert.deepEqual(there.lock, [{at_mm: [2, -6, 14], radius_mm: 8}]);
  assert.deepEqual(there.poses?.[0], {stand: {contacts: [{at_mm: [0, 0, 12]}]}});
  assert.deepEqual(there.handles?.[0]?.turn_deg?.map(Math.round), [0, -30, 0]);
  const back = carried(there, change.clone().invert());
  assert.deepEqual(back.lock, job.lock);
  assert.deepEqual(back.handles?.[0]?.to_mm, [5, 6, 9]);
  assert.deepEqual(back.poses?.[1]?.hang?.from_mm, [[1, 1, 9]]);
});

test('the key of a placement sees the placement and nothing else', () => {
  assert.equal(placeKey({wall_mm: 2}), placeKey({}));
  assert.notEqual(placeKey({place: {up: 'y'}}), placeKey({}));
});

import assert from 'node:assert/strict';
import {test} from 'node:test';

import {Vector3} from 'three';

import type {PoseReport} from '../src/results/report';
import {type StandResult, isBent, keyOf, nothing, shownJudgement} from '../src/results/results';
import {heldPoses, poseVerdict, verdictOf} from '../src/results/verdict';
import {degrees, wayOf} from '../src/results/words';
import {counterclockwise, inset, tipTowardsDeg} from '../src/view/balance';
import {orbited} from '../src/view/orbit';
import {paintBall} from '../src/view/paint';
import {Surface} from '../src/view/surface';

const square = [{x: -1, y: -1}, {x: 1, y: -1}, {x: 1, y: 1}, {x: -1, y: 1}];

test('towards an edge it tips at the angle of the margin over the height', () => {
  const balance = {polygon: counterclockwise([...square].reverse()), com: [0.5, 0, 2] as const};
  assert.ok(Math.abs(tipTowardsDeg(balance, {x: 1, y: 0}) - (Math.atan2(0.5, 2) * 180) / Math.PI) < 1e-9);
  assert.ok(Math.abs(tipTowardsDeg(balance, {x: -1, y: 0}) - (Math.atan2(1.5, 2) * 180) / Math.PI) < 1e-9);
  assert.ok(tipTowardsDeg({...balance, com: [1.5, 0, 2]}, {x: 1, y: 0}) < 0);
});

test('a polygon moved inward by more than it is wide is empty', () => {
  assert.equal(inset(square, 0.5).length, 4);
  assert.equal(inset(square, 1.5).length, 0);
});

test('directions are said as seen from the front', () => {
  assert.equal(wayOf([1, 0, 0], [0, 0, 1]), 'to the right');
  assert.equal(wayOf([-1, 0.1, 0], [0, 0, 1]), 'to the left');
  assert.equal(wayOf([0, -1, 0], [0, 0, 1]), 'forwards');
  assert.equal(wayOf([1, -1, 0], [0, 0, 1]), 'to the front right');
  assert.equal(degrees(-7.94), '\u22127.9');
  assert.equal(degrees(-0.04), '0.0');
});

const standing = (tip_deg: number): PoseReport => ({
  name: 'pose 1', kind: 'standing', up: [0, 0, 1], required_tip_deg: 10, holds: tip_deg >= 10,
  before: {mass_g: 1, volume_mm3: 1, com_mm: [0, 0, 1], tip_deg, weak_edge: {from_mm: [0, 0, 0], to_mm: [0, 1, 0], heading: [-1, 0, 0]}},
});

const hanging = (tilt_deg: number): PoseReport => ({
  name: 'pose 2', kind: 'hanging', up: [0, 0, 1], required_tilt_deg: 2, holds: tilt_deg <= 2,
  before: {mass_g: 1, volume_mm3: 1, com_mm: [0, 0, 1], tilt_deg},
});

test('the verdict falls, stands barely or stands', () => {
  const line = (tip: number) => poseVerdict(standing(tip), standing(tip).before).line;
  assert.equal(line(-7.9), 'Falls to the left: \u22127.9 degrees');
  assert.equal(line(3.2), 'Stands, but barely: 3.2 degrees');
  assert.equal(line(10.3), 'Stands: 10.3 degrees');
  assert.equal(line(9.999), 'Stands: 10.0 degrees');
});

const doc = {model: {id: 1, name: 'a.stl', bytes: 1}, profile: null, job: {}, frame: ''};
const judgement = {process: 'fdm', passes: true, checks: [], findings: []};
const stood = (tip: number, code: number): StandResult => ({
  key: keyOf(doc), message: '', code, voids: [], dense: null, isWritten: code === 0, report: {outcome: '', poses: [{...standing(-2), after: standing(tip).before}], judgement},
  outside: code ? null : {name: 'outside', positions: new Float32Array(), triangles: new Uint32Array()},
});

test('a result is of its own job, and says when nothing was made', () => {
  const line = (stand: StandResult, of: typeof doc) => verdictOf({...nothing, stand}, of, 0).line;
  assert.equal(line(stood(10.4, 0), doc), 'Stands: 10.4 degrees');
  assert.equal(line(stood(2.1, 3), doc), 'Nothing made: 2.1 degrees at best');
  assert.equal(line(stood(10.4, 0), {...doc, job: {wall_mm: 3}}), '');
});

test('a solid bent by hand says what carving it could reach, in each of its poses', () => {
  const bent = {...doc, job: {poses: [{stand: {}}, {hang: {from_mm: [[0, 0, 1] as const]}}],
                              handles: [{at_mm: [0, 0, 1] as const, to_mm: [0, 0, 2] as const}]}};
  const preview = {wish: 1, settled: true, mean_mm: 1, max_mm: 1, handle_short_mm: 0, poses: [
    {...standing(-3), carved_deg: 4.25}, {...hanging(5), carved_deg: null}]};
  const results = {...nothing, preview: {key: keyOf(bent), preview, positions: null}};
  assert.equal(verdictOf(results, bent, 0).line, 'Falls to the left: \u22123.0 degrees');
  assert.equal(verdictOf(results, bent, 0).detail, 'as bent by hand, solid: 10.0 asked; carved it could reach 4.3');
  assert.equal(verdictOf(results, bent, 1).detail, 'as bent by hand, solid: level to 2.0 asked');
  assert.deepEqual(heldPoses(results, bent), {held: 0, all: 2});
  const further = {...bent, job: {...bent.job, wall_mm: 2}};
  assert.equal(verdictOf(results, further, 0).line, '', 'it is of another job');
  assert.notEqual(verdictOf(results, further, 0, true).line, '', 'until the next one comes the last holds');
});

test('what was made is judged by the run that made it, not by what was said of the model', () => {
  const asked = {key: keyOf(doc), of: 'model' as const, judgement: {...judgement, passes: false}};
  assert.equal(shownJudgement({...nothing, judgement: asked}, doc)?.of, 'model');
  assert.equal(shownJudgement({...nothing, judgement: asked, stand: stood(10.4, 0)}, doc)?.of, 'result');
});

const tetrahedron = () => new Surface({
  name: 'model', positions: new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]),
  triangles: new Uint32Array([0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3]),
});

test('a surface knows its outside, its lowest point and how far it was moved', () => {
  const surface = tetrahedron();
  assert.ok(surface.facesOutward());
  assert.equal(surface.lowest(0, 0, -1), -1);
  assert.deepEqual(surface.farthest([0, 1, 0]), [0, 1, 0]);
  const moved = Float32Array.from(surface.positions, (value, i) => (i === 11 ? value + 3 : value));
  assert.equal(surface.move(moved), 3);
  assert.equal(surface.positions[11], 4);
  assert.equal(surface.move(null), 0);
  assert.equal(surface.positions[11], 1);
});

test('paint is where the ball is', () => {
  const surface = tetrahedron();
  paintBall(surface, [1, 0, 0], 0.5, 2);
  assert.deepEqual([...surface.paint], [0, 2, 0, 0]);
});

test('a result is of another shape than the model where it was bent, and only of its own job', () => {
  const made = stood(10.4, 0), bent = {...made, report: {...made.report, deformation: {max_mm: 2}}};
  assert.ok(isBent({...nothing, stand: bent}, doc));
  assert.ok(!isBent({...nothing, stand: made}, doc));
  assert.ok(!isBent({...nothing, stand: bent}, {...doc, job: {wall_mm: 3}}));
  assert.ok(!isBent({...nothing, stand: {...bent, outside: null}}, doc), 'nothing was made');
});

test('who goes round the figure to the right sees more of its right side, and does not go over the top', () => {
  const front = new Vector3(0, -10, 0), right = orbited(front, 15, 0), above = orbited(front, 0, 30);
  assert.ok(Math.abs(right.x - 10 * Math.sin(Math.PI / 12)) < 1e-9 && right.y < 0 && Math.abs(right.z) < 1e-9, JSON.stringify(right));
  assert.ok(Math.abs(above.z - 5) < 1e-9 && Math.abs(above.x) < 1e-9, JSON.stringify(above));
  const top = orbited(front, 0, 170);
  assert.ok(top.y <= 0 && top.z > 9.99 && Math.abs(top.length() - 10) < 1e-9, JSON.stringify(top));
});

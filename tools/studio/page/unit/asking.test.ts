import assert from 'node:assert/strict';
import {test} from 'node:test';

import {Conductor} from '../src/results/conductor';
import {type Results, isUnanswered, nothing} from '../src/results/results';
import {shownPreview} from '../src/results/verdict';
import {DocumentStore} from '../src/state/document';
import type {Job} from '../src/state/job';
import {Signal} from '../src/state/signal';
import {Client} from '../src/transport/client';
import {end, json, mesh, positions, stream} from './frames';

const model = {id: 100, name: 'a.stl', bytes: 1};
const placed = {
  type: 'placed', triangles: 1, box_mm: [[0, 0, 0], [1, 1, 1]], volume_mm3: 1, center_mm: [0, 0, 0], notes: [],
  from_file: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0],
};
const cancelled = stream(json({type: 'cancelled'}), end), fails = stream(json({type: 'error', code: 2, message: 'a.stl: it holds no triangles'}), end);
const answers: Record<string, Uint8Array> = {
  '/api/place': stream(json(placed), mesh('model'), end),
  '/api/check': stream(json({type: 'report', report: {outcome: '', poses: []}, message: ''}), end),
  '/api/preview': stream(json({type: 'preview', wish: 1, settled: true, poses: []}), positions([0, 0, 0, 1, 0, 0, 0, 1, 0.5]), end),
};

/** A page without its panels, over a server that answers as it is told, else as it should. What is 'open' ends when it is aborted, a preview with a run. */
function studio(told: Record<string, (Uint8Array | 'open')[]> = {}) {
  const asked: string[] = [], documents = new DocumentStore(), results = new Signal<Results>(nothing);
  const previews: ReadableStreamDefaultController[] = [];
  const fetcher = async (path: string, init: RequestInit) => {
    const [route, name] = path.split('?name=') as [string, string | undefined], answer = told[route]?.shift() ?? answers[route];
    asked.push(route);
    if (name) return new Response(JSON.stringify({id: asked.length, name, bytes: 1}));
    if (route === '/api/stand')
      for (const preview of previews.splice(0)) {
        preview.enqueue(cancelled);
        preview.close();
      }
    return new Response(new ReadableStream({start: (controller) => {
      init.signal?.addEventListener('abort', () => controller.error(new DOMException('aborted', 'AbortError')));
      if (answer === 'open') return void (route === '/api/preview' && previews.push(controller));
      controller.enqueue(answer);
      controller.close();
    }}));
  };
  const conductor = new Conductor(new Client('t', fetcher as typeof fetch), documents, results, 1000);
  return {asked, documents, results, conductor};
}

async function until(isSo: () => boolean): Promise<void> {
  for (let tries = 0; !isSo(); ++tries) {
    assert.ok(tries < 600, 'it does not come');
    await new Promise((resolve) => setTimeout(resolve, 5));
  }
}

const file = (name: string, text = '') => new File([text], name);
const pulled: Job = {deform: 'auto', handles: [{at_mm: [0, 0, 1], to_mm: [0, 0, 2]}]};

test('what the server had to end is asked again while the document is the same', async () => {
  const {asked, documents, results} = studio({'/api/place': [cancelled], '/api/check': [cancelled]});
  documents.open(model);
  await until(() => results.value.check !== null);
  assert.deepEqual(asked, ['/api/place', '/api/place', '/api/check', '/api/check']);
  assert.equal(results.value.placed?.mesh.name, 'model');
  assert.deepEqual([results.value.busy, results.value.notice], [null, null]);
});

test('who is kept from an answer again and again is told so, and may ask once more', async () => {
  const {documents, results, conductor} = studio({'/api/check': Array(4).fill(cancelled)});
  documents.open(model);
  await until(() => results.value.notice !== null);
  assert.ok(isUnanswered(results.value, documents.doc));
  results.patch({notice: null});
  assert.ok(isUnanswered(results.value, documents.doc), 'that the notice was put away changes nothing');
  conductor.again();
  await until(() => results.value.check !== null);
  assert.ok(!isUnanswered(results.value, documents.doc));
});

test('cancel ends a run, and nothing that the verdict needs', async () => {
  const {asked, documents, results, conductor} = studio({'/api/place': ['open'], '/api/stand': ['open']});
  documents.open(model);
  conductor.cancel();
  assert.equal(results.value.busy?.what, 'read');
  documents.change({wall_mm: 2}, 'wall');
  await until(() => results.value.check !== null);
  void conductor.runs.stand();
  await until(() => asked.includes('/api/stand'));
  conductor.cancel();
  await until(() => results.value.busy === null);
  assert.ok(!asked.includes('/api/cancel'), 'other pages’ work goes on');
});

test('after a run that made nothing, the preview that it ended is asked again', async () => {
  const {asked, documents, results, conductor} = studio({'/api/preview': ['open'], '/api/stand': ['open']});
  documents.open(model, pulled);
  await until(() => asked.includes('/api/preview'));
  void conductor.runs.stand();
  await until(() => asked.includes('/api/stand'));
  conductor.cancel();
  await until(() => results.value.preview !== null);
  assert.equal(asked.filter((route) => route === '/api/preview').length, 2);
});

test('a figure that handles bend stays as it was shown until the next answer, also while that is checked', async () => {
  const {asked, documents, results, conductor} = studio({'/api/check': [answers['/api/check']!, 'open']});
  const shown = () => shownPreview(results.value, documents.asked, conductor.answering);
  documents.open(model, pulled);
  await until(() => !conductor.answering);
  const before = shown();
  assert.ok(before !== null);
  documents.change({...pulled, handles: [...pulled.handles!, {at_mm: [1, 0, 0]}]}, 'add a handle');
  assert.equal(shown(), before, 'as soon as it is asked');
  await until(() => asked.filter((route) => route === '/api/check').length === 2);
  assert.equal(shown(), before, 'while it is checked');
});

test('a file that cannot be read changes nothing', async () => {
  const {documents, results, conductor} = studio({'/api/place': [fails, answers['/api/place']!, fails]});
  await conductor.opening.take(file('bad.stl'));
  assert.deepEqual([documents.doc.model, results.value.busy], [null, null]);
  assert.match(results.value.notice!.sentence, /no triangles/);
  await conductor.opening.take(file('b.stl'));
  await until(() => results.value.check !== null);
  documents.change({wall_mm: 2}, 'wall');
  await conductor.opening.take(file('bad.stl'));
  assert.deepEqual([documents.doc.model?.name, documents.doc.job], ['b.stl', {wall_mm: 2}]);
  assert.equal(results.value.busy, null);
});

test('a job file is one step of the open model, without the files that it names', async () => {
  const {asked, documents, results, conductor} = studio();
  const saved = file('a-job.json', JSON.stringify({aplomb_job: 1, model: 'other.stl', output: 'a.3mf', wall_mm: 3, ballast: 'only'}));
  await conductor.opening.take(saved);
  assert.match(results.value.notice!.sentence, /^a-job.json is a job: open the model first$/);
  documents.open(model);
  await conductor.opening.take(saved);
  assert.deepEqual(documents.doc.job, {wall_mm: 3});
  assert.match(results.value.notice!.sentence, /made for other.stl/);
  await conductor.opening.take(file('newer.json', '{"aplomb_job": 2}'));
  assert.match(results.value.notice!.sentence, /another version/);
  documents.undo();
  assert.deepEqual(documents.doc.job, {});
  await conductor.opening.take(file('cura.json', '{"layer_height": 0.2}'));
  assert.ok(asked.includes('/api/profile'), 'other JSON is a slicer’s');
});

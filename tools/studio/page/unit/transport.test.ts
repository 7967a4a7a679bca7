import assert from 'node:assert/strict';
import {test} from 'node:test';

import {Client, Refusal, nameIn, tokenOf} from '../src/transport/client';
import {type Frame, FrameReader} from '../src/transport/frames';
import {Newest} from '../src/transport/newest';
import {end, frame, json, mesh, stream} from './frames';

test('frames are the same however the bytes are cut', () => {
  const bytes = stream(json({type: 'placed', volume: 2}), mesh('model'), mesh('outside1'), end);
  for (const step of [1, 3, 7, 8, 64, bytes.length]) {
    const reader = new FrameReader(), frames: Frame[] = [];
    for (let at = 0; at < bytes.length; at += step) frames.push(...reader.push(bytes.slice(at, at + step)));
    assert.deepEqual(frames.map((one) => one.kind), ['json', 'mesh', 'mesh', 'end'], `in steps of ${step}`);
    const first = frames[1];
    assert.ok(first?.kind === 'mesh');
    assert.equal(first.mesh.name, 'model');
    assert.deepEqual([...first.mesh.positions], [0, 0, 0, 1, 0, 0, 0, 1, 0.5]);
    assert.deepEqual([...first.mesh.triangles], [0, 1, 2]);
    assert.ok(reader.ended);
  }
});

test('a ticket of the address is changed for the token, once', async () => {
  const asked: unknown[] = [];
  const fetcher = (async (path: string, init: RequestInit) => {
    asked.push([path, init.method, init.body]);
    return new Response('{"token": "abc"}');
  }) as typeof fetch;
  assert.equal(await tokenOf('once-123', fetcher), 'abc');
  assert.equal(await tokenOf('def', fetcher), 'def');
  assert.deepEqual(asked, [['/api/token', 'POST', '{"name":"123"}']]);
});

test('a frame that this page does not know is an error', () => {
  assert.throws(() => new FrameReader().push(frame(9, new Uint8Array(4))), /kind 9/);
});

function answering(...chunks: Uint8Array[]): typeof fetch {
  return async () => new Response(new ReadableStream({
    start: (controller) => {
      for (const chunk of chunks) controller.enqueue(chunk);
      controller.close();
    },
  }));
}

async function all(fetcher: typeof fetch): Promise<Frame[]> {
  const frames: Frame[] = [];
  for await (const one of new Client('t', fetcher).stream('/api/check', {}, new AbortController().signal)) frames.push(one);
  return frames;
}

test('heartbeats are not given out, and a stream without its end was cut off', async () => {
  const frames = await all(answering(json({type: 'alive'}), json({type: 'report'}), end));
  assert.deepEqual(frames.map((one) => one.kind === 'json' && one.message.type), ['report']);
  await assert.rejects(all(answering(json({type: 'report'}))), /cut off/);
});

test('a refusal is the server’s own sentence, and a wrong token is said to be one', async () => {
  const refusing = (status: number, body: string): typeof fetch => async () => new Response(body, {status});
  const ask = (fetcher: typeof fetch) => new Client('t', fetcher).json('/api/fixture', {});
  await assert.rejects(ask(refusing(409, '{"error": "that model is no longer here", "code": 1}')),
    (error) => error instanceof Refusal && error.message === 'that model is no longer here' && error.code === 1);
  await assert.rejects(ask(refusing(401, '')), /token/);
  await assert.rejects(ask(async () => { throw new TypeError('fetch failed'); }), /does not answer/);
});

test('the token goes in a header and in no address', async () => {
  let asked: [string, RequestInit] | null = null;
  const fetcher = async (path: string, init: RequestInit) => ((asked = [path, init]), new Response('{}'));
  await new Client('secret', fetcher as typeof fetch).json('/api/start');
  const [path, init] = asked as unknown as [string, RequestInit];
  assert.equal((init.headers as Record<string, string>).Authorization, 'Bearer secret');
  assert.equal(init.method, 'GET');
  assert.ok(!path.includes('secret'));
});

test('file names come out of Content-Disposition', () => {
  assert.equal(nameIn('attachment; filename="trex_.3mf"; filename*=UTF-8\'\'trex%C3%A4.3mf'), 'trexä.3mf');
  assert.equal(nameIn('attachment; filename="trex.3mf"'), 'trex.3mf');
});

async function idle(newest: Newest<number>): Promise<void> {
  while (newest.busy) await new Promise((resolve) => setTimeout(resolve, 1));
}

test('of many wishes the first and the newest are done, and what is served is ended by a newer one', async () => {
  const begun: number[] = [], ended: [number, boolean][] = [];
  let open = () => {};
  const gate = new Promise<void>((resolve) => (open = resolve));
  const newest = new Newest<number>(async (wish, turn) => {
    begun.push(wish);
    await gate;
    turn.served();
    ended.push([wish, turn.signal.aborted]);
  }, (error) => assert.fail(String(error)));
  for (let wish = 0; wish < 10; ++wish) newest.ask(wish);
  assert.deepEqual(begun, [0], 'what is not served yet goes on');
  open();
  await idle(newest);
  assert.deepEqual(ended, [[0, true], [9, false]]);
});

test('what is being served is ended at once by a newer wish', async () => {
  const ended: number[] = [];
  const newest = new Newest<number>((wish, turn) => new Promise((resolve) => {
    turn.signal.addEventListener('abort', () => (ended.push(wish), resolve()));
    turn.served();
    if (wish === 2) resolve();
  }), (error) => assert.fail(String(error)));
  newest.ask(1);
  newest.ask(2);
  await idle(newest);
  assert.deepEqual(ended, [1]);
});

test('what fails is told, and the next wish is done all the same', async () => {
  const told: unknown[] = [], done: number[] = [];
  const newest = new Newest<number>(async (wish) => {
    if (wish === 1) throw new Error('no');
    done.push(wish);
  }, (error) => told.push(error));
  for (const wish of [1, 2]) {
    newest.ask(wish);
    await idle(newest);
  }
  assert.equal(told.length, 1);
  assert.deepEqual(done, [2]);
});

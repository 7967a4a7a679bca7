// Handles, locks, placement and poses, with undo and redo.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {test} from 'node:test';

import {decodePng} from './support/png.mjs';
import {drag, drawn, openPage, take, verdict, withFolder} from './support/studio.mjs';

// Where the T-Rex is in the first picture at 1280 x 800.
const eye = [640, 330], flank = [480, 430];

async function jobOf(page) {
  return withFolder(async (folder) => JSON.parse(readFileSync(await take(page, 'job', folder), 'utf8')));
}

/** Pixels that differ by more than a shade. */
async function changed(page, before) {
  await drawn(page);
  const now = decodePng(await page.screenshot()), then = decodePng(before);
  let count = 0;
  for (let y = 130; y < 730; y += 2)
    for (let x = 100; x < 950; x += 2) if (Math.abs(now.at(x, y)[0] - then.at(x, y)[0]) > 12) ++count;
  return count;
}

export function shaping(bench) {
  test('while a handle is dragged vertices move and the verdict changes; undo takes it back', async (t) => {
    const page = await openPage(bench.browser, bench.coarse.address), solid = await verdict(page);
    await drawn(page);
    await page.keyboard.press('h');
    await page.mouse.click(...eye);
    await page.getByRole('button', {name: 'handle 1', exact: true}).waitFor();
    await drawn(page);
    const before = await page.screenshot(), seen = new Set();
    await drag(page, eye, [-60, -10], 30, async () => {
      await page.waitForTimeout(60);
      seen.add(await page.textContent('#verdict'));
    });
    await page.locator('#moved', {hasText: 'previews a second'}).waitFor();
    assert.ok(seen.size > 1, `while dragging: ${[...seen].join('; ')}`);
    assert.notEqual(await verdict(page), solid);
    assert.match(await verdict(page), /as bent by hand/);
    assert.ok(await changed(page, before) > 300);
    const moved = /up to ([\d.]+) mm.*?([\d.]+) previews a second/.exec(await page.textContent('#moved'));
    assert.ok(Number(moved[1]) > 0.5, moved[0]);
    t.diagnostic(`${moved[2]} previews a second while 30 moves were made`);
    const [handle] = (await jobOf(page)).handles;
    assert.ok(handle.to_mm[0] < handle.at_mm[0] - 1, JSON.stringify(handle));
    await page.keyboard.press('Control+z');
    assert.equal(await verdict(page, /Falls/), solid);
    assert.equal(await page.locator('#moved').isVisible(), false);
    assert.deepEqual(page.complaints, []);
    await page.context().close();
  });

  test('what is painted is locked; undo and redo', async () => {
    const page = await openPage(bench.browser, bench.coarse.address), locked = page.getByText('where painted');
    await verdict(page);
    await drawn(page);
    await page.keyboard.press('l');
    await drag(page, flank, [-60, 0], 12);
    await locked.waitFor();
    const {lock} = await jobOf(page);
    assert.ok(lock.length > 3 && lock.every((ball) => ball.radius_mm > 0), JSON.stringify(lock));
    await page.keyboard.press('Control+z');
    await locked.waitFor({state: 'hidden'});
    await page.keyboard.press('Control+Shift+z');
    await locked.waitFor();
    assert.deepEqual((await jobOf(page)).lock, lock);
    await page.context().close();
  });

  test('another placement carries what was painted along, and is one step to undo', async () => {
    const page = await openPage(bench.browser, bench.coarse.address), solid = await verdict(page);
    await drawn(page);
    await page.keyboard.press('l');
    await page.mouse.click(...flank);
    await page.getByText('where painted').waitFor();
    const [{at_mm: from}] = (await jobOf(page)).lock;
    await page.locator('summary', {hasText: 'Placement'}).click();
    await page.getByLabel('Turn, z').first().fill('90');
    await page.getByLabel('Turn, z').first().press('Enter');
    await verdict(page, /backwards/);
    const [{at_mm: to}] = (await jobOf(page)).lock;
    [-from[1], from[0], from[2]].forEach((value, axis) => assert.ok(Math.abs(value - to[axis]) < 0.01, `${from} to ${to}`));
    await page.keyboard.press('Escape');
    await page.keyboard.press('Control+z');
    assert.equal(await verdict(page, /to the right/), solid);
    assert.deepEqual((await jobOf(page)).lock[0].at_mm, from);
    await page.context().close();
  });

  test('a face is laid on the plate', async () => {
    const page = await openPage(bench.browser, bench.coarse.address), solid = await verdict(page);
    await drawn(page);
    await page.keyboard.press('f');
    await page.mouse.click(...flank);
    await page.locator('#verdict-detail').waitFor();
    await page.waitForTimeout(300);
    await page.locator('#undo:not(:disabled)').waitFor();
    const {place} = await jobOf(page);
    assert.equal(place.rotate_deg.length, 3);
    assert.notEqual(await verdict(page), solid);
    await page.context().close();
  });

  test('two poses are two tabs, each with its verdict, and one of them may hang', async () => {
    const page = await openPage(bench.browser, bench.coarse.address);
    await verdict(page, /Falls to the right/);
    await page.click('.tab.add');
    assert.match(await verdict(page, /\u2212(?!2\.2)/), /of 2 poses hold/);
    assert.equal(await page.locator('[role=tab][data-tone=falls]').count(), 2);
    await page.getByLabel('It', {exact: true}).selectOption('hang');
    await verdict(page, /Hangs/);
    await page.locator('[role=tab]').first().click();
    await verdict(page, /Falls to the right: \u22122\.2/);
    const {poses} = await jobOf(page);
    assert.ok(poses[0].stand && poses[1].hang, JSON.stringify(poses));
    await page.context().close();
  });

  test('the way it falls is shown on request, and comes to rest again', async () => {
    const page = await openPage(bench.browser, bench.coarse.address);
    await verdict(page);
    await drawn(page);
    const before = await page.screenshot();
    await page.click('#fall');
    await page.waitForTimeout(1500);
    assert.ok(await changed(page, before) > 1000, 'it has fallen');
    await page.waitForTimeout(2500);
    await page.mouse.move(20, 790);
    assert.ok(await changed(page, before) < 300, 'it stands where it stood');
    await page.context().close();
  });
}

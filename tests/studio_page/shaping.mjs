// Handles, locks, placement and poses, with undo and redo. One page for all; each test leaves it as it found it.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {after, before, describe, test} from 'node:test';

import {changed, drag, drawn, openPage, runOf, take, verdict, withFolder} from './support/studio.mjs';

// Where the T-Rex is in the first picture at 1280 x 800.
const eye = [640, 330], flank = [480, 430];
const solid = /^Falls to the right: \u22122\.2 degrees/;

const jobOf = (page) => withFolder(async (folder) => JSON.parse(readFileSync(await take(page, 'job', folder), 'utf8')));

/** Whether what the hand asked for last is drawn. (waitForFunction cannot wait here: the page's policy forbids its eval.) */
const isAnswered = (page) => page.evaluate(() => {
  const [asked, shown] = ['aplomb-wish', 'aplomb-preview-drawn'].map((name) => performance.getEntriesByName(name).at(-1)?.detail ?? 0);
  return shown >= asked;
});

export function shaping(bench) {
  describe('shaping', () => {
    let page;
    before(async () => {
      page = await openPage(bench.browser, bench.coarse.address);
      await verdict(page, solid);
      await drawn(page);
    });
    after(() => page.context().close());

    test('the way it falls is shown on request, and it stands again where it stood', async () => {
      const before = await page.screenshot();
      // The clock of the page is in our hands: where a picture takes longer than a fall, none would show it.
      await page.evaluate(() => {
        const began = performance.now();
        globalThis.since_ms = 0;
        performance.now = () => began + globalThis.since_ms;
      });
      const at = (ms) => page.evaluate((now) => void (globalThis.since_ms = now), ms);
      await page.click('#fall');
      await at(1300); // it lies
      const most = await changed(page, before);
      assert.ok(most >= 1000, `${most} points moved`);
      await at(2300); // and has lain for as long as it does
      await page.mouse.move(20, 790);
      const left = await changed(page, before);
      assert.ok(left < 100, `${left} points are not as they were`);
      await page.evaluate(() => delete performance.now);
    });

    test('while a handle is dragged vertices move and the verdict changes; undo takes it back', async (t) => {
      await page.keyboard.press('h');
      await page.mouse.click(...eye);
      await page.getByRole('button', {name: 'handle 1', exact: true}).waitFor();
      await drawn(page);
      const before = await page.screenshot(), seen = new Set();
      await drag(page, eye, [-60, -10], 30, async (step) => {
        await page.waitForTimeout(60);
        seen.add(await page.textContent('#verdict'));
        while (step === 30 && !(await isAnswered(page))) await page.waitForTimeout(30); // the hand lets go no sooner
      });
      await page.locator('#cancel').waitFor(); // when the hand rests the full answer follows, unless it is told not to
      process.kill(await runOf(bench.coarse.pid), 'SIGSTOP'); // lest it end before
      await page.getByLabel('Answer at once').uncheck();
      await page.click('#cancel');
      await page.locator('#moved', {hasText: 'previews a second'}).waitFor();
      await page.locator('#verdict-detail', {hasText: 'as bent by hand'}).waitFor();
      assert.doesNotMatch(await verdict(page), solid);
      assert.ok(await changed(page, before) > 300);
      const [said, way, rate] = /up to ([\d.]+) mm.*?([\d.]+) previews a second/.exec(await page.textContent('#moved'));
      assert.ok(Number(way) > 0.5, said);
      t.diagnostic(`${rate} previews a second, ${seen.size} verdicts while 30 moves were made`);
      const [handle] = (await jobOf(page)).handles;
      assert.ok(handle.to_mm[0] < handle.at_mm[0] - 1, JSON.stringify(handle));
      await page.mouse.click(...flank);
      await page.locator('.chip[aria-pressed="true"]', {hasText: 'handle 2'}).waitFor();
      await page.mouse.click(eye[0] - 30, eye[1] - 5);
      await page.locator('.chip[aria-pressed="true"]', {hasText: 'handle 1'}).waitFor(); // on its way: it is taken, not made anew
      await page.keyboard.press('Control+z');
      await page.locator('.chip').nth(1).waitFor({state: 'detached'}); // with the next picture
      assert.equal(await page.locator('.chip').count(), 1);
      await page.keyboard.press('Control+z');
      await verdict(page, solid);
      await page.locator('#moved').waitFor({state: 'hidden'});
      await page.keyboard.press('Control+z');
      assert.equal((await jobOf(page)).handles, undefined);
    });

    test('what is painted is locked, carried along when the model is turned, and undone step by step', async () => {
      const locked = page.getByText('where painted');
      await page.keyboard.press('l');
      await drag(page, flank, [-60, 0], 12);
      await locked.waitFor();
      const {lock} = await jobOf(page), from = lock[0].at_mm;
      assert.ok(lock.length > 3 && lock.every((ball) => ball.radius_mm > 0), JSON.stringify(lock));
      await page.keyboard.press('Control+z');
      await locked.waitFor({state: 'hidden'});
      await page.keyboard.press('Control+Shift+z');
      await locked.waitFor();
      await page.locator('summary', {hasText: 'Placement'}).click();
      await page.getByLabel('Turn, z').first().fill('90');
      await page.getByLabel('Turn, z').first().press('Enter');
      await verdict(page, /backwards/);
      const to = (await jobOf(page)).lock[0].at_mm;
      [-from[1], from[0], from[2]].forEach((value, axis) => assert.ok(Math.abs(value - to[axis]) < 0.01, `${from} to ${to}`));
      await page.keyboard.press('Escape');
      await page.keyboard.press('Control+z');
      await verdict(page, solid);
      assert.deepEqual((await jobOf(page)).lock, lock);
      await page.keyboard.press('Control+z');
      await locked.waitFor({state: 'hidden'});
    });

    test('a face is laid on the plate', async () => {
      await page.keyboard.press('0');
      await drawn(page);
      await page.keyboard.press('f');
      await page.mouse.click(...flank);
      await verdict(page, /^(?!Falls to the right: \u22122\.2)(Falls|Stands)/);
      assert.equal((await jobOf(page)).place.rotate_deg.length, 3);
      await page.keyboard.press('Control+z');
      await verdict(page, solid);
    });

    test('two poses are two tabs, each with its verdict, and one of them may hang', async () => {
      await page.click('.tab.add');
      assert.match(await verdict(page, /\u2212(?!2\.2)/), /0 of 2 poses hold/);
      assert.equal(await page.locator('[role=tab][data-tone=falls]').count(), 2);
      await page.getByLabel('This pose').selectOption('hang');
      await verdict(page, /Hangs/);
      await page.locator('[role=tab]').first().click();
      await verdict(page, solid);
      const {poses} = await jobOf(page);
      assert.ok(poses[0].stand && poses[1].hang, JSON.stringify(poses));
      assert.deepEqual(page.complaints, []);
    });
  });
}

// From the empty page to a verdict.
import assert from 'node:assert/strict';
import {spawnSync} from 'node:child_process';
import {join} from 'node:path';
import {test} from 'node:test';
import {writeFileSync} from 'node:fs';

import {angleIn, changed, drawn, openPage, programs, verdict} from './support/studio.mjs';

export function opening(bench) {
  test('the empty page invites, a fixture is weighed at once, and the page keeps to its content policy', async () => {
    const page = await openPage(bench.browser, bench.empty.address);
    await page.locator('.welcome').waitFor();
    await page.click('[data-fixture="trex.stl"]');
    assert.match(await verdict(page), /^Falls to the right: \u22122\.2 degrees/);
    assert.equal(await page.locator('.welcome').isVisible(), false);
    await drawn(page);
    assert.deepEqual(page.complaints, []);
    await page.context().close();
  });

  test('a bad file ends in the command line’s sentence and changes nothing; a good one is weighed', async () => {
    const page = await openPage(bench.browser, bench.empty.address), bad = join(bench.folder, 'bad.stl');
    writeFileSync(bad, 'solid nothing\nendsolid nothing\n');
    const sentence = spawnSync(programs.cli, ['check', bad], {encoding: 'utf8'}).stderr.trim().split(': ').at(-1);
    await page.locator('.welcome input[type=file]').setInputFiles(bad);
    await page.locator('#notice', {hasText: sentence}).waitFor();
    assert.ok(sentence.length > 10 && await page.locator('.welcome').isVisible(), sentence);
    await page.click('#open');
    await page.locator('dialog input[type=file]').setInputFiles(join(programs.fixtures, 'duck.stl'));
    const duck = await verdict(page);
    assert.ok(angleIn(duck) > 10);
    assert.equal(await page.locator('#notice').isVisible(), false);
    await page.locator('dialog input[type=file]').setInputFiles(bad);
    await page.locator('#notice', {hasText: sentence}).waitFor();
    assert.equal(await page.textContent('.model-name'), 'duck.stl');
    assert.equal(await verdict(page), duck);
    await page.context().close();
  });

  test('a job that was saved is opened again, and the page asks before work is lost', async () => {
    const page = await openPage(bench.browser, bench.empty.address), file = join(bench.folder, 'saved.json');
    const job = {aplomb_job: 1, model: 'trex.stl', material: 'petg', poses: [{stand: {tip_deg: 7}}]};
    writeFileSync(file, JSON.stringify(job));
    await page.locator('.welcome input[type=file]').setInputFiles(file);
    await page.locator('#notice', {hasText: 'open the model first'}).waitFor();
    await page.click('[data-fixture="duck.stl"]');
    await verdict(page, /Stands/);
    await page.setInputFiles('#profile-file', file);
    await page.locator('#notice', {hasText: 'made for trex.stl'}).waitFor();
    await page.locator('#verdict-detail', {hasText: '7.0 asked'}).waitFor();
    assert.equal(await page.getByLabel('Material').inputValue(), 'petg');
    writeFileSync(file, JSON.stringify({...job, wall_mm: 'thick'}));
    await page.setInputFiles('#profile-file', file);
    await page.locator('#notice', {hasText: 'wall_mm'}).waitFor();
    assert.match(await verdict(page, /Stands/), /7\.0 asked/);
    const asked = page.waitForEvent('dialog');
    await page.evaluate(() => setTimeout(() => location.reload()));
    assert.equal((await asked).type(), 'beforeunload');
    await (await asked).accept();
    await page.locator('.welcome').waitFor();
    await page.context().close();
  });

  test('nothing is cut off at 1280 x 800, and every control has a name', async () => {
    const page = await openPage(bench.browser, bench.coarse.address);
    await verdict(page);
    const outside = await page.evaluate(() => [...document.querySelectorAll('button, h1, input, select')]
      .filter((one) => one.offsetParent && !one.closest('.scrolled, dialog, .marks, .unseen'))
      .filter((one) => {
        const box = one.getBoundingClientRect();
        return box.left < 0 || box.top < 0 || box.right > innerWidth || box.bottom > innerHeight || one.scrollWidth > one.clientWidth + 1;
      }).map((one) => one.outerHTML.slice(0, 80)));
    assert.deepEqual(outside, []);
    const nameless = await page.evaluate(() => [...document.querySelectorAll('button, input, select')]
      .filter((one) => !(one.textContent.trim() || one.getAttribute('aria-label') || one.title || one.labels?.length))
      .map((one) => one.outerHTML.slice(0, 80)));
    assert.deepEqual(nameless, []);
    await page.context().close();
  });

  test('a change is drawn once', async () => {
    const page = await openPage(bench.browser, bench.coarse.address);
    await verdict(page, /Falls/);
    await drawn(page);
    await page.evaluate(() => {
      const {clear} = WebGL2RenderingContext.prototype;
      globalThis.pictures = 0;
      WebGL2RenderingContext.prototype.clear = function (...what) {
        ++globalThis.pictures; // each begins with it
        return clear.apply(this, what);
      };
    });
    for (let pictures = 1; pictures <= 4; ++pictures) {
      await page.getByRole('button', {name: 'Ring', exact: true}).click();
      await drawn(page);
      assert.equal(await page.evaluate(() => globalThis.pictures), pictures);
    }
    await page.context().close();
  });

  test('arrows go round the figure, and dark stays dark at the next port', async () => {
    const page = await openPage(bench.browser, bench.coarse.address, {colorScheme: 'light'});
    await verdict(page, /Falls/);
    await drawn(page);
    await page.locator('canvas').focus();
    assert.equal(await page.evaluate(() => document.activeElement.tagName), 'CANVAS');
    const before = await page.screenshot();
    await page.keyboard.press('ArrowRight');
    const others = await changed(page, before);
    assert.ok(others > 1000, `${others} points`);
    await page.getByRole('button', {name: 'Light or dark'}).click();
    await page.goto(bench.empty.address);
    await page.locator('.welcome').waitFor();
    assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), 'dark');
    await page.context().close();
  });

  test('a wrong token is told to be one', async () => {
    const page = await openPage(bench.browser, `${new URL(bench.empty.address).origin}/#wrong`);
    await page.getByText('token is missing or wrong').waitFor();
    assert.equal(await page.locator('canvas').count(), 0);
    await page.context().close();
  });
}

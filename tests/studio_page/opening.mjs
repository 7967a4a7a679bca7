// From the empty page to a verdict.
import assert from 'node:assert/strict';
import {join} from 'node:path';
import {test} from 'node:test';
import {writeFileSync} from 'node:fs';

import {angleIn, drawn, openPage, programs, verdict} from './support/studio.mjs';

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

  test('a file that is chosen is weighed, a bad one ends in the program’s own sentence', async () => {
    const page = await openPage(bench.browser, bench.empty.address), bad = join(bench.folder, 'bad.stl');
    writeFileSync(bad, 'solid nothing\nendsolid nothing\n');
    await page.locator('.welcome input[type=file]').setInputFiles(bad);
    await page.locator('#notice').waitFor();
    const said = await page.textContent('#notice p');
    assert.ok(said.length > 10 && !said.includes('undefined'), said);
    await page.click('#open');
    await page.locator('dialog input[type=file]').setInputFiles(join(programs.fixtures, 'duck.stl'));
    assert.ok(angleIn(await verdict(page)) > 10);
    assert.equal(await page.locator('#notice').isVisible(), false);
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

  test('a wrong token is told to be one', async () => {
    const page = await openPage(bench.browser, `${new URL(bench.empty.address).origin}/#wrong`);
    await page.getByText('token is missing or wrong').waitFor();
    assert.equal(await page.locator('canvas').count(), 0);
    await page.context().close();
  });
}

// One button makes it stand; what is taken away agrees with the command line.
import assert from 'node:assert/strict';
import {execFileSync, spawnSync} from 'node:child_process';
import {copyFileSync, readFileSync} from 'node:fs';
import {join} from 'node:path';
import {test} from 'node:test';

import {countPixels, decodePng} from './support/png.mjs';
import {angleIn, drawn, openPage, programs, take, verdict, withFolder} from './support/studio.mjs';

/** The blue of what is empty, in any light. */
const isVoid = (red, green, blue) => blue > red + 35 && blue > green + 20;
const scene = {left: 100, top: 130, right: 955, bottom: 740};

async function voidPixels(page) {
  await drawn(page);
  return countPixels(decodePng(await page.screenshot()), isVoid, scene);
}

export function making(bench) {
  test('made to stand, cut open, taken away: page and command line agree', async () => {
    const page = await openPage(bench.browser, bench.coarse.address);
    const before = angleIn(await verdict(page, /Falls/));
    await page.getByRole('button', {name: 'Ring'}).click();
    await page.click('[data-look="section"]');
    const solid = await voidPixels(page);
    await page.click('#make');
    const after = angleIn(await verdict(page, /Stands: /));
    assert.ok(before < 0 && after >= 10, `${before}, ${after}`);
    await page.locator('#make', {hasText: 'Made'}).waitFor();
    const open = await voidPixels(page);
    assert.ok(open > 5000 && open > 10 * solid, `${solid} pixels of void before, ${open} after`);
    await withFolder(async (folder) => {
      const [print, job, html] = [await take(page, '3mf', folder), await take(page, 'job', folder), await take(page, 'html', folder)];
      const checked = execFileSync(programs.cli, ['check', print], {encoding: 'utf8'});
      assert.equal(angleIn(checked), after);
      const validated = spawnSync(programs.cli, ['validate', print], {encoding: 'utf8'});
      assert.equal(validated.status === 0, /prints/.test(await page.textContent('.prints')), validated.stdout);
      assert.match(readFileSync(html, 'utf8'), /Stands now/);
      copyFileSync(join(programs.fixtures, 'trex.stl'), join(folder, 'trex.stl'));
      execFileSync(programs.cli, ['run', job, '-o', join(folder, 'again.3mf')], {stdio: 'ignore'});
      assert.ok(readFileSync(join(folder, 'again.3mf')).equals(readFileSync(print)), 'the job has other bytes on the command line');
    });
    assert.deepEqual(page.complaints, []);
    await page.context().close();
  });

  test('what is changed makes the result old, and undo makes it new again', async () => {
    const page = await openPage(bench.browser, bench.coarse.address);
    await verdict(page, /Falls/);
    await page.keyboard.press('Control+Enter');
    await verdict(page, /Stands: /);
    await page.getByLabel('Material').selectOption('abs');
    await verdict(page, /Falls/);
    assert.ok(await page.locator('[data-take="3mf"]').isDisabled());
    await page.keyboard.press('Control+z');
    await verdict(page, /Stands: /);
    await page.context().close();
  });

  test('findings are listed, and marked where they are', async () => {
    const page = await openPage(bench.browser, bench.coarse.address);
    await verdict(page);
    await page.click('#judge');
    await page.locator('.findings li').first().waitFor();
    const marks = page.locator('.finding-mark'), count = await marks.count();
    assert.ok(count > 0);
    const number = await marks.first().textContent();
    await marks.first().evaluate((mark) => mark.click());
    await page.locator(`.findings li.open[data-number="${number}"]`).waitFor();
    await page.context().close();
  });

  test('a run can be cancelled and begun anew', async () => {
    const page = await openPage(bench.browser, bench.coarse.address);
    await verdict(page);
    await page.getByLabel('Material').selectOption('petg');
    await verdict(page);
    await page.click('#make');
    await page.locator('#cancel').waitFor();
    await page.keyboard.press('Escape');
    await page.locator('#make').waitFor();
    assert.match(await verdict(page), /Falls/);
    await page.click('#make');
    await verdict(page, /Stands: /);
    await page.context().close();
  });
}

// One button makes it stand; what is taken away agrees with the command line. One page for all, which ends as it began.
import assert from 'node:assert/strict';
import {execFileSync, spawnSync} from 'node:child_process';
import {copyFileSync, mkdirSync, readFileSync} from 'node:fs';
import {basename, join} from 'node:path';
import {after, before, describe, test} from 'node:test';

import {countPixels, decodePng} from './support/png.mjs';
import {angleIn, drawn, openPage, programs, take, verdict, withFolder} from './support/studio.mjs';

/** The blue of what is empty, in any light. */
const isVoid = (red, green, blue) => blue > red + 35 && blue > green + 20;
const scene = {left: 100, top: 130, right: 955, bottom: 740};

async function voidPixels(page) {
  await drawn(page);
  return countPixels(decodePng(await page.screenshot()), isVoid, scene);
}

/** The same job, the same model and the same name of the output, elsewhere. */
function runAgain(job, print, folder) {
  const elsewhere = join(folder, 'again'), output = join(elsewhere, basename(print));
  mkdirSync(elsewhere);
  copyFileSync(join(programs.fixtures, 'trex.stl'), join(elsewhere, 'trex.stl'));
  copyFileSync(job, join(elsewhere, 'job.json'));
  execFileSync(programs.cli, ['run', 'job.json', '-o', basename(print)], {cwd: elsewhere, stdio: 'ignore'});
  return readFileSync(output);
}

export function making(bench) {
  describe('making', () => {
    let page;
    before(async () => {
      page = await openPage(bench.browser, bench.coarse.address);
    });
    after(() => page.context().close());

    test('a run can be cancelled', async () => {
      await verdict(page, /Falls/);
      await page.click('#make');
      await page.locator('#cancel').waitFor();
      await page.keyboard.press('Escape');
      await page.locator('#make').waitFor();
      assert.match(await verdict(page), /Falls/);
      assert.equal(await page.locator('#notice').isVisible(), false);
    });

    test('made to stand, and cut open, it shows its void', async () => {
      const was = angleIn(await verdict(page, /Falls/));
      await page.getByRole('button', {name: 'Ring'}).click();
      await page.keyboard.press('3');
      const solid = await voidPixels(page);
      await page.keyboard.press('Control+Enter');
      const is = angleIn(await verdict(page, /Stands: /));
      assert.ok(was < 0 && is >= 10, `${was}, ${is}`);
      await page.locator('#make', {hasText: 'Made'}).waitFor();
      const open = await voidPixels(page);
      assert.ok(open > 5000 && open > 10 * solid, `${solid} pixels of void before, ${open} after`);
    });

    test('what is taken away is what the command line makes and judges', async () => {
      await withFolder(async (folder) => {
        const [print, job, html] = [await take(page, '3mf', folder), await take(page, 'job', folder), await take(page, 'html', folder)];
        assert.equal(angleIn(execFileSync(programs.cli, ['check', print], {encoding: 'utf8'})), angleIn(await verdict(page)));
        const validated = spawnSync(programs.cli, ['validate', print], {encoding: 'utf8'});
        assert.equal(validated.status === 0, / prints/.test(await page.textContent('.prints')), validated.stdout);
        assert.match(readFileSync(html, 'utf8'), /Stands now/);
        assert.ok(runAgain(job, print, folder).equals(readFileSync(print)), 'the job has other bytes on the command line');
      });
    });

    test('what is changed makes the result old, and undo makes it new again', async () => {
      await page.getByLabel('Material').selectOption('abs');
      await verdict(page, /Falls/);
      assert.ok(await page.locator('[data-take="3mf"]').isDisabled());
      await page.keyboard.press('Control+z');
      await verdict(page, /Stands: /);
      assert.equal(await page.locator('[data-take="3mf"]').isDisabled(), false);
    });

    test('findings are listed, and marked where they are', async () => {
      await page.getByLabel('Material').selectOption('petg');
      await verdict(page, /Falls/);
      await page.click('#judge');
      await page.locator('.findings li.fail').first().waitFor();
      const mark = page.locator('.finding-mark').first();
      await mark.dispatchEvent('click'); // it may lie under another one
      await page.locator(`.findings li.open[data-number="${await mark.textContent()}"]`).waitFor();
    });

    test('where it is asked for, a run begins when the hand rests, and once for each job', async () => {
      const once = page.getByLabel('Answer at once');
      await once.check();
      await page.click('#cancel');
      await page.locator('#make').waitFor();
      await page.waitForTimeout(500);
      assert.equal(await page.locator('#cancel').isVisible(), false);
      await once.uncheck();
      assert.deepEqual(page.complaints, []);
    });
  });
}

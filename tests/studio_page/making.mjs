// One button makes it stand; what is taken away agrees with the command line. One page for all, which ends as it began.
import assert from 'node:assert/strict';
import {execFileSync, spawnSync} from 'node:child_process';
import {copyFileSync, mkdirSync, readFileSync} from 'node:fs';
import {basename, join} from 'node:path';
import {after, before, describe, test} from 'node:test';

import {countPixels, decodePng} from './support/png.mjs';
import {angleIn, drawn, openPage, programs, runOf, take, verdict, withFolder} from './support/studio.mjs';

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

    test('while it runs, what is typed stays, a slow press is one, and arrow keys go from tab to tab', async () => {
      const page = await openPage(bench.browser, bench.empty.address); // on its fine grid a run outlasts all of this
      const tabs = page.locator('[role=tab]'), asked = page.getByLabel('Asked'), aWhile = () => page.waitForTimeout(300);
      await page.click('[data-fixture="trex.stl"]');
      await verdict(page, /Falls/);
      await page.click('.tab.add');
      await verdict(page, /0 of 2|\u2212(?!2\.2)/);
      await page.click('#make');
      await page.locator('#cancel').waitFor();
      await asked.focus();
      for (const key of '12') {
        await page.keyboard.press(key);
        await aWhile();
      }
      assert.equal(await asked.inputValue(), '12');
      await asked.fill(''); // as it was
      await tabs.first().hover();
      await page.mouse.down();
      await aWhile();
      await page.mouse.up();
      await page.locator('[role=tab][aria-selected="true"]', {hasText: 'pose 1'}).waitFor();
      for (const name of ['pose 2', 'pose 1', 'pose 2']) {
        await page.keyboard.press('ArrowRight');
        await page.locator('[role=tab]:focus', {hasText: name}).waitFor();
        await aWhile();
        assert.equal(await page.evaluate(() => document.activeElement.textContent), name);
      }
      assert.ok(await page.locator('#cancel').isVisible(), 'it ran all the while');
      await page.keyboard.press('Control+z');
      await page.locator('#make').waitFor();
      await page.context().close();
    });

    test('a run can be cancelled', async () => {
      await verdict(page, /Falls/);
      await page.click('#make');
      await page.locator('#cancel').waitFor();
      process.kill(await runOf(bench.coarse.pid), 'SIGSTOP'); // lest it end before
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
      assert.ok(await page.locator('[data-take="3mf"]').isEnabled(), 'it is written, and may be saved, while the report is drawn');
      await page.locator('#make', {hasText: 'Made'}).waitFor();
      const open = await voidPixels(page);
      assert.ok(open > 5000 && open > 10 * solid, `${solid} pixels of void before, ${open} after`);
      await page.click('#cut-at');
      await page.keyboard.press('1'); // a slider has the focus, and no use for it
      await page.locator('[data-look="solid"][aria-pressed="true"]').waitFor();
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
      const marks = await page.locator('.finding-mark').all();
      assert.ok(marks.length > 1);
      for (const mark of marks) { // a pointer reaches each of them
        await mark.click();
        await page.locator(`.findings li.open[data-number="${await mark.textContent()}"]`).waitFor();
      }
    });

    test('where it is asked for, a run begins when the hand rests, and once for each job', async () => {
      const once = page.getByLabel('Answer at once');
      await once.check();
      process.kill(await runOf(bench.coarse.pid), 'SIGSTOP'); // lest it end before
      await page.click('#cancel');
      await page.locator('#make').waitFor();
      await page.waitForTimeout(500);
      assert.equal(await page.locator('#cancel').isVisible(), false);
      await once.uncheck();
      assert.deepEqual(page.complaints, []);
    });
  });
}

// With a slicer's profile it is what is printed that stands, and mass moves by infill.
import assert from 'node:assert/strict';
import {spawnSync} from 'node:child_process';
import {readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {test} from 'node:test';

import {angleIn, openPage, programs, take, verdict, withFolder} from './support/studio.mjs';

const profile = 'perimeters = 2\nfill_density = 15%\nlayer_height = 0.2\nfirst_layer_height = 0.2\nfilament_density = 1.3\n';

export function slicing(bench) {
  test('a profile is chosen, what is sliced is made to stand by denser infill, and undo takes it back', async () => {
    await withFolder(async (folder) => {
      const page = await openPage(bench.browser, bench.empty.address), file = join(folder, 'mine.ini'), bad = join(folder, 'bad.ini');
      writeFileSync(file, profile);
      writeFileSync(bad, 'nothing is set here');
      await page.click('[data-fixture="trex.stl"]');
      await verdict(page, /Falls/);
      await page.getByLabel('Asked').fill('3');
      await page.getByLabel('Asked').press('Enter');
      await page.locator('#verdict-detail', {hasText: '3.0 asked'}).waitFor();
      const solid = await verdict(page, /Falls/);
      assert.match(solid, /as a solid$/);
      await page.setInputFiles('#profile-file', bad);
      await page.locator('#notice', {hasText: 'bad.ini'}).waitFor();
      while (!page.complaints.length) await page.waitForEvent('console');
      assert.match(page.complaints.splice(0).join(' '), /400/, 'Chromium tells of a refusal');
      await page.setInputFiles('#profile-file', file);
      await page.locator('#verdict-detail', {hasText: 'as it would be sliced'}).waitFor();
      const checked = spawnSync(programs.cli, ['check', join(programs.fixtures, 'trex.stl'), '--profile', file], {encoding: 'utf8'});
      assert.equal(angleIn(await verdict(page)), angleIn(checked.stdout));
      assert.equal(await page.locator('#notice').isVisible(), false);
      await page.click('#make');
      await verdict(page, /Stands: /);
      assert.ok(await page.locator('[data-take="3mf"]').isEnabled());
      assert.ok(await page.locator('[data-take="stl"]').isDisabled());
      assert.match(readFileSync(await take(page, '3mf', folder), 'latin1'), /^PK/);
      await page.keyboard.press('Control+z');
      assert.equal(await verdict(page, /Falls/), solid);
      assert.deepEqual(page.complaints, []);
      await page.context().close();
    });
  });
}

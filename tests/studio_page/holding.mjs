// What is drawn is freed when something else is drawn in its place.
import assert from 'node:assert/strict';
import {test} from 'node:test';

import {drawn, openPage, verdict} from './support/studio.mjs';

/** Geometries and textures that WebGL holds, as the page says after each picture that changed them. */
const heldBy = (page) => page.evaluate(() => performance.getEntriesByName('aplomb-held').at(-1).detail);

const modelsDrawn = (page) => page.evaluate(() => performance.getEntriesByName('aplomb-model-drawn').length);

export function holding(bench) {
  test('a model that is opened again and again, seen through and cut, holds no more of WebGL than once', async (t) => {
    const page = await openPage(bench.browser, bench.empty.address), held = [];
    for (let times = 1; times <= 4; ++times) {
      if (times > 1) await page.click('#open');
      await page.click(`${times > 1 ? 'dialog' : '.welcome'} [data-fixture="trex.stl"]`);
      while ((await modelsDrawn(page)) < times) await page.waitForTimeout(50);
      await verdict(page, /Falls/);
      for (const look of ['3', '2', '1']) {
        await page.keyboard.press(look);
        await drawn(page);
      }
      held.push(await heldBy(page));
    }
    t.diagnostic(JSON.stringify(held[0]));
    assert.ok(held[0].geometries > 5);
    for (const one of held) assert.deepEqual(one, held[0], JSON.stringify(held));
    assert.deepEqual(page.complaints, []);
    await page.context().close();
  });
}

// The solver dies: that is a message, and the next try works.
import assert from 'node:assert/strict';
import {test} from 'node:test';

import {childrenOf, openPage, runOf, startStudio, verdict} from './support/studio.mjs';

export function failing(bench) {
  test('when the solver’s processes are killed there is a message, and the next try works', async () => {
    const page = await openPage(bench.browser, bench.coarse.address);
    await verdict(page, /Falls/);
    await page.click('#make');
    await page.locator('#progress').waitFor();
    const run = await runOf(bench.coarse.pid), killed = childrenOf(bench.coarse.pid);
    assert.ok(killed.includes(run) && killed.length > 1, `${killed}, the run is ${run}`);
    for (const pid of killed) process.kill(pid, 'SIGKILL');
    await page.locator('#notice').waitFor();
    assert.match(await page.textContent('#notice p'), /^the solver was ended by signal 9 .*the next try starts another$/);
    assert.match(await page.textContent('#verdict'), /Falls/);
    await page.click('#make');
    await verdict(page, /Stands: /);
    assert.equal(await page.locator('#notice').isVisible(), false);
    await page.context().close();
  });

  test('a server that has gone is told to be gone', async () => {
    const studio = await startStudio(), page = await openPage(bench.browser, studio.address);
    await page.locator('.welcome').waitFor();
    await studio.stop();
    await page.click('[data-fixture="trex.stl"]');
    await page.locator('#notice', {hasText: 'does not answer any more'}).waitFor();
    await page.context().close();
  });
}

// The studio as its users have it: the real server, the real solver, the page in Chromium. Two servers for all of it: one that
// begins empty, one that begins with a job on a coarse grid, so that runs take little time.
import {after, before, describe} from 'node:test';
import {copyFileSync, mkdtempSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';

import {launchBrowser, programs, startStudio} from './support/studio.mjs';
import {failing} from './failing.mjs';
import {holding} from './holding.mjs';
import {making} from './making.mjs';
import {opening} from './opening.mjs';
import {shaping} from './shaping.mjs';
import {slicing} from './slicing.mjs';

const coarse = {aplomb_job: 1, model: 'trex.stl', voxel_mm: 0.8, ceiling: 'any'};
const bench = {}; // browser, empty, coarse: filled before the first test

describe('studio', () => {
  before(async () => {
    bench.folder = mkdtempSync(join(tmpdir(), 'aplomb-page-'));
    copyFileSync(join(programs.fixtures, 'trex.stl'), join(bench.folder, 'trex.stl'));
    writeFileSync(join(bench.folder, 'job.json'), JSON.stringify(coarse));
    bench.browser = await launchBrowser();
    bench.empty = await startStudio();
    bench.coarse = await startStudio(join(bench.folder, 'job.json'));
  });
  after(async () => {
    await bench.browser?.close();
    for (const studio of [bench.empty, bench.coarse]) await studio?.stop();
    rmSync(bench.folder, {recursive: true, force: true});
  });
  opening(bench);
  making(bench);
  shaping(bench);
  slicing(bench);
  holding(bench);
  failing(bench);
});

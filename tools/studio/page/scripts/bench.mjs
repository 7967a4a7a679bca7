// Measures the page with the real server in Chromium: from pointer move to the picture that has it, start to first picture, memory.
// `tools/studio/page/bench [triangles...]`, default 20000 100000 500000; of what is built in build/release, with the packages of tests/studio_page.
import {mkdtempSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';

import {childrenOf, drawn, launchBrowser, openPage, startStudio, verdict} from '../../../../tests/studio_page/support/studio.mjs';

const sizes = process.argv.length > 2 ? process.argv.slice(2).map(Number) : [20_000, 100_000, 500_000];
const drag_ms = 8000, moves_per_s = 60;

/** A leaning vase of revolution, 100 mm high, with a flat foot and lid, as a binary STL. */
function leaningVase(triangles) {
  const around = Math.round(Math.sqrt(triangles / 2)), up = Math.round(triangles / 2 / around) - 1;
  const at = (ring, n) => {
    const z = (100 * ring) / up, r = 16 + 9 * Math.sin(z / 14), angle = (2 * Math.PI * n) / around;
    return [r * Math.cos(angle) + 0.25 * z, r * Math.sin(angle), z];
  };
  const faces = [];
  for (let n = 0; n < around; ++n) {
    const next = (n + 1) % around;
    for (let ring = 0; ring < up; ++ring)
      faces.push([at(ring, n), at(ring, next), at(ring + 1, next)], [at(ring, n), at(ring + 1, next), at(ring + 1, n)]);
    faces.push([[0, 0, 0], at(0, next), at(0, n)], [[25, 0, 100], at(up, n), at(up, next)]);
  }
  const bytes = Buffer.alloc(84 + 50 * faces.length);
  bytes.writeUInt32LE(faces.length, 80);
  faces.forEach((face, i) => face.flat().forEach((value, k) => bytes.writeFloatLE(value, 84 + 50 * i + 12 + 4 * k)));
  return {bytes, triangles: faces.length};
}

const megabytes = (pid) => Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${pid}/status`, 'utf8'))?.[1] ?? 0) / 1024;
const quantile = (values, share) => [...values].sort((a, b) => a - b)[Math.min(values.length - 1, Math.floor(share * values.length))];

/** From each wish to the first picture of it or of a newer one, ms. */
function latencies(marks) {
  const shown = marks.filter((mark) => mark.name === 'aplomb-preview-drawn');
  return marks.filter((mark) => mark.name === 'aplomb-wish').flatMap((wish) => {
    const picture = shown.find((mark) => mark.wish >= wish.wish && mark.at >= wish.at);
    return picture ? [picture.at - wish.at] : [];
  });
}

/** Of the browser's processes. CPU time says what the page costs on a machine that others use, too. */
async function processes(browser) {
  const session = await browser.newBrowserCDPSession(), {processInfo} = await session.send('SystemInfo.getProcessInfo');
  await session.detach();
  return {
    cpu_s: processInfo.filter((one) => one.type !== 'browser').reduce((sum, one) => sum + one.cpuTime, 0),
    mb: (type) => processInfo.filter((one) => one.type === type).reduce((most, one) => Math.max(most, megabytes(one.id)), 0),
  };
}

const marksOf = (page) => page.evaluate(() => performance.getEntriesByType('mark').map(({name, startTime, detail}) => ({name, at: startTime, wish: detail})));

async function measure(browser, folder, wanted) {
  const {bytes, triangles} = leaningVase(wanted), file = join(folder, `vase-${wanted}.stl`);
  writeFileSync(file, bytes);
  const began = Date.now(), studio = await startStudio(file), ready = Date.now() - began;
  const idle = await processes(browser), page = await openPage(browser, studio.address);
  page.setDefaultTimeout(120_000);
  await verdict(page);
  await drawn(page);
  const shown = await processes(browser), first = (await marksOf(page)).find((mark) => mark.name === 'aplomb-model-drawn').at;
  await page.keyboard.press('h');
  const middle = [480, 330];
  await page.mouse.click(...middle);
  await page.getByRole('button', {name: 'handle 1', exact: true}).waitFor();
  await drawn(page);
  const still = await processes(browser);
  await page.mouse.move(...middle);
  await page.mouse.down();
  for (const end = Date.now() + drag_ms; Date.now() < end; ) {
    const turn = ((Date.now() - end) / 1000) * 2;
    await page.mouse.move(middle[0] + 40 * Math.sin(turn), middle[1] + 12 * Math.sin(1.7 * turn));
    await page.waitForTimeout(1000 / moves_per_s);
  }
  const marks = await marksOf(page), waits = latencies(marks);
  const pictures = marks.filter((mark) => mark.name === 'aplomb-preview-drawn').length;
  await page.mouse.up();
  const dragged = await processes(browser);
  const row = {
    triangles, moves: waits.length, 'pictures/s': (pictures / drag_ms) * 1000, 'median ms': quantile(waits, 0.5), '95 % ms': quantile(waits, 0.95),
    'page CPU ms a picture': (1000 * (dragged.cpu_s - still.cpu_s)) / pictures, 'start to picture s': (ready + first) / 1000,
    'of it page CPU s': shown.cpu_s - idle.cpu_s, 'page MB': dragged.mb('renderer'), 'WebGL MB': dragged.mb('GPU'),
    'server MB': megabytes(studio.pid), 'solver MB': Math.max(0, ...childrenOf(studio.pid).map(megabytes)),
  };
  await page.context().close();
  await studio.stop();
  return Object.fromEntries(Object.entries(row).map(([key, value]) => [key, value >= 100 ? Math.round(value) : Math.round(value * 100) / 100]));
}

const folder = mkdtempSync(join(tmpdir(), 'aplomb-bench-'));
try {
  const rows = [];
  for (const size of sizes) {
    const browser = await launchBrowser(); // a new one each time: nothing is left of the last
    rows.push(await measure(browser, folder, size));
    await browser.close();
  }
  const keys = Object.keys(rows[0]);
  console.log(`| ${keys.join(' | ')} |\n|${keys.map(() => '---|').join('')}`);
  for (const row of rows) console.log(`| ${keys.map((key) => row[key]).join(' | ')} |`);
} finally {
  rmSync(folder, {recursive: true, force: true});
}

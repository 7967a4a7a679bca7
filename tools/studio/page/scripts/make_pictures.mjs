// Makes tools/studio/pictures/*.png: the main states of the page, in Chromium, of what is built in build/release.
// It uses the tests' packages: `npm ci` in tests/studio_page comes first.
import {existsSync, mkdirSync, writeFileSync} from 'node:fs';
import {dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';

import {drawn, launchBrowser, openPage, startStudio, verdict} from '../../../../tests/studio_page/support/studio.mjs';
import {decodePng, encodePalettePng, halved} from '../../../../tests/studio_page/support/png.mjs';

const folder = process.argv[2] ?? join(dirname(fileURLToPath(import.meta.url)), '..', '..', 'pictures');
const most_bytes = 150_000;
if (!existsSync(folder)) mkdirSync(folder, {recursive: true});

async function picture(page, name) {
  await page.evaluate(() => {
    document.activeElement.blur(); // no ring of the focus
    document.querySelector('.scrolled').scrollTop = 0;
  });
  await page.mouse.move(700, 90);
  await page.waitForTimeout(300); // what moves has come to rest
  await drawn(page);
  const bytes = encodePalettePng(halved(decodePng(await page.screenshot())));
  if (bytes.length > most_bytes) throw new Error(`${name}.png has ${bytes.length} bytes, ${most_bytes} are the limit`);
  writeFileSync(join(folder, `${name}.png`), bytes);
  console.log(`${name}.png  ${Math.round(bytes.length / 1000)} kB`);
}

/** Folds a part of the panel away, or opens it, so that what the picture is of is in it. */
const fold = (page, title) => page.locator('.section > summary', {hasText: title}).click();

async function openFixture(page, name) {
  await page.click(`.welcome [data-fixture="${name}"]`);
  await verdict(page);
  await drawn(page);
}

/** Waits for the last of the previews: nothing new is said for some seconds. */
async function settled(page) {
  const said = () => page.evaluate(() => ['#verdict', '#verdict-detail', '#moved'].map((one) => document.querySelector(one).textContent).join());
  for (let last = '', now = await said(); now !== last; [last, now] = [now, await said()]) await page.waitForTimeout(4000);
}

async function makeItStand(page) {
  await page.click('#make');
  await verdict(page, /Stands: /);
  await page.locator('#make', {hasText: 'Made'}).waitFor();
}

const browser = await launchBrowser(), studio = await startStudio();
const begin = async () => {
  const page = await openPage(browser, studio.address, {deviceScaleFactor: 2}); // drawn twice as fine, then halved: smooth edges
  page.setDefaultTimeout(180_000);
  await page.locator('.welcome').waitFor();
  return page;
};

async function carved() {
  const page = await begin();
  await picture(page, 'empty');
  await openFixture(page, 'trex.stl');
  await picture(page, 'falling');
  await fold(page, 'Making');
  await page.click('#judge');
  await page.locator('.findings li').first().waitFor();
  await drawn(page);
  await page.locator('.finding-mark').last().click();
  await picture(page, 'findings');
  await fold(page, 'Making');
  await makeItStand(page);
  await page.evaluate(() => document.activeElement.blur());
  await page.keyboard.press('2');
  await picture(page, 'standing');
  await page.keyboard.press('3');
  await picture(page, 'section');
  await page.emulateMedia({colorScheme: 'dark'});
  await picture(page, 'dark');
  await page.context().close();
}

/** Bent by the keys, so that nothing is said of how fast a hand was answered. */
async function bent() {
  const page = await begin();
  await openFixture(page, 'trex.stl');
  await fold(page, 'Making');
  await page.keyboard.press('h');
  await page.mouse.click(640, 330);
  await page.getByRole('button', {name: 'handle 1', exact: true}).waitFor();
  await page.evaluate(() => document.activeElement.blur());
  for (let step = 0; step < 10; ++step) await page.keyboard.press('ArrowLeft');
  await page.locator('#verdict-detail', {hasText: 'as bent by hand'}).waitFor();
  await settled(page);
  await picture(page, 'handle');
  await page.context().close();
}

/** What a slicer would fill by 15 %, made to stand by denser infill. */
async function ballasted() {
  const page = await begin(), profile = ['perimeters = 2', 'fill_density = 15%', 'layer_height = 0.2', 'first_layer_height = 0.2',
                                         'filament_density = 1.3', ''].join('\n');
  await openFixture(page, 'trex.stl');
  await page.getByLabel('Asked').fill('3');
  await page.getByLabel('Asked').press('Enter');
  await page.setInputFiles('#profile-file', {name: 'draft.ini', mimeType: 'text/plain', buffer: Buffer.from(profile)});
  await page.locator('#verdict-detail', {hasText: 'as it would be sliced'}).waitFor();
  await makeItStand(page);
  await page.evaluate(() => document.activeElement.blur());
  await page.keyboard.press('3');
  await picture(page, 'ballast');
  await page.context().close();
}

await carved();
await bent();
await ballasted();
await browser.close();
await studio.stop();

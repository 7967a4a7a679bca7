// Makes tools/studio/pictures/*.png: the main states of the page, in Chromium, of what is built in build/release.
// It uses the tests' packages: `npm ci` in tests/studio_page comes first.
import {existsSync, mkdirSync, writeFileSync} from 'node:fs';
import {dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';

import {drag, drawn, launchBrowser, openPage, startStudio, verdict} from '../../../../tests/studio_page/support/studio.mjs';
import {decodePng, encodePalettePng, halved} from '../../../../tests/studio_page/support/png.mjs';

const folder = process.argv[2] ?? join(dirname(fileURLToPath(import.meta.url)), '..', '..', 'pictures');
const most_bytes = 150_000;
if (!existsSync(folder)) mkdirSync(folder, {recursive: true});

async function picture(page, name) {
  await page.mouse.move(700, 90);
  await page.waitForTimeout(300); // what moves has come to rest
  await drawn(page);
  const bytes = encodePalettePng(halved(decodePng(await page.screenshot())));
  if (bytes.length > most_bytes) throw new Error(`${name}.png has ${bytes.length} bytes, ${most_bytes} are the limit`);
  writeFileSync(join(folder, `${name}.png`), bytes);
  console.log(`${name}.png  ${Math.round(bytes.length / 1000)} kB`);
}

async function openFixture(page, name) {
  await page.click(`.welcome [data-fixture="${name}"]`);
  await verdict(page);
  await drawn(page);
}

const browser = await launchBrowser(), studio = await startStudio();
const page = await openPage(browser, studio.address, {deviceScaleFactor: 2}); // drawn twice as fine, then halved: smooth edges
page.setDefaultTimeout(180_000);
await page.locator('.welcome').waitFor();
await picture(page, 'empty');
await openFixture(page, 'trex.stl');
await picture(page, 'falling');
await page.click('#judge');
await page.locator('.findings li').first().waitFor();
await page.locator('.finding-mark').last().evaluate((mark) => mark.click());
await picture(page, 'findings');
await page.click('#make');
await verdict(page, /Stands: /);
await page.locator('#make', {hasText: 'Made'}).waitFor();
await page.keyboard.press('2');
await picture(page, 'standing');
await page.keyboard.press('3');
await picture(page, 'section');
await page.click('#light');
await picture(page, 'dark');
await page.click('#light');
await page.keyboard.press('1');
await page.keyboard.press('h');
await page.mouse.click(640, 330);
await page.getByRole('button', {name: 'handle 1', exact: true}).waitFor();
await drag(page, [640, 330], [-50, -8], 10, () => page.waitForTimeout(150));
await page.locator('#verdict-detail', {hasText: 'as bent by hand'}).waitFor();
await picture(page, 'handle');
await browser.close();
await studio.stop();

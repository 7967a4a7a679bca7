// The real server and a real browser, for tests, pictures and benches.
import {spawn} from 'node:child_process';
import {mkdtempSync, readFileSync, readdirSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {dirname, join} from 'node:path';
import {createInterface} from 'node:readline';
import {fileURLToPath} from 'node:url';

import {chromium} from 'playwright-core';

import {decodePng} from './png.mjs';

const root = join(dirname(fileURLToPath(import.meta.url)), '..', '..', '..'), tools = join(root, 'build', 'release', 'tools');

/** What is tested: as ctest names it, else what lies in build/release. */
export const programs = {
  studio: process.env.APLOMB_STUDIO ?? join(tools, 'studio', 'aplomb-studio'),
  cli: process.env.APLOMB_CLI ?? join(tools, 'cli', 'aplomb'),
  fixtures: process.env.APLOMB_FIXTURES ?? join(root, 'fixtures'),
};

/** Starts a server of its own; `file` is what it begins with. */
export async function startStudio(...args) {
  const child = spawn(programs.studio, ['--no-browser', '--port', '0', ...args], {stdio: ['ignore', 'pipe', 'pipe']});
  const address = await new Promise((resolve, reject) => {
    const said = [];
    for (const from of [child.stdout, child.stderr])
      createInterface({input: from}).on('line', (line) => {
        said.push(line);
        const found = /http:\/\/\S+/.exec(line);
        if (found) resolve(found[0]);
      });
    child.on('exit', (code) => reject(new Error(`aplomb-studio ended with ${code}: ${said.join('\n')}`)));
  });
  const ended = new Promise((resolve) => child.on('exit', resolve));
  return {address, pid: child.pid, stop: async () => (child.kill('SIGINT'), ended)};
}

export function launchBrowser() {
  return chromium.launch({
    executablePath: process.env.APLOMB_CHROMIUM ?? '/usr/bin/chromium',
    args: ['--no-sandbox', '--enable-unsafe-swiftshader'], // as a machine without a graphics card draws
  });
}

/** A page of the studio. What it complains of is in `complaints`: a page in order has none. */
export async function openPage(browser, address, options = {}) {
  const context = await browser.newContext({viewport: {width: 1280, height: 800}, deviceScaleFactor: 1, acceptDownloads: true, ...options});
  const page = await context.newPage(), complaints = [];
  page.setDefaultTimeout(60_000);
  page.on('console', (message) => message.type() === 'error' && complaints.push(message.text()));
  page.on('pageerror', (error) => complaints.push(error.stack));
  await page.goto(address);
  return Object.assign(page, {complaints});
}

/** Waits for a verdict that a pattern finds. \return what it says, with its detail. */
export async function verdict(page, pattern = /Falls|Stands|Hangs/) {
  await page.locator('#verdict', {hasText: pattern}).waitFor();
  return `${await page.textContent('#verdict')} | ${await page.textContent('#verdict-detail')}`;
}

/** The first angle in a text, with either minus. */
export function angleIn(text) {
  const found = /([-\u2212]?)(\d+\.\d+) degrees/.exec(text);
  if (!found) throw new Error(`no angle in: ${text}`);
  return (found[1] ? -1 : 1) * Number(found[2]);
}

/** Two pictures' time, so that what was asked to be drawn is drawn. */
export async function drawn(page) {
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(done)))));
}

/** Points of the scene that are drawn otherwise, by more than a shade. */
export async function changed(page, before) {
  await drawn(page);
  const now = decodePng(await page.screenshot()), then = decodePng(before);
  let count = 0;
  for (let y = 130; y < 730; y += 2)
    for (let x = 100; x < 950; x += 2) if (Math.abs(now.at(x, y)[0] - then.at(x, y)[0]) > 12) ++count;
  return count;
}

/** Presses a place of the window, drags it in steps, and lets go. `each` is called between the steps. */
export async function drag(page, from, by, steps, each = () => page.waitForTimeout(30)) {
  await page.mouse.move(from[0], from[1]);
  await page.mouse.down();
  for (let step = 1; step <= steps; ++step) {
    await page.mouse.move(from[0] + (by[0] * step) / steps, from[1] + (by[1] * step) / steps);
    await each(step);
  }
  await page.mouse.up();
}

/** Saves what there is to take away. \return the path of the file. */
export async function take(page, what, folder) {
  const [download] = await Promise.all([page.waitForEvent('download'), page.click(`[data-take="${what}"]`)]);
  const path = join(folder, download.suggestedFilename());
  await download.saveAs(path);
  return path;
}

/** A folder that goes when `use` is through with it. */
export async function withFolder(use) {
  const folder = mkdtempSync(join(tmpdir(), 'aplomb-page-'));
  try {
    return await use(folder);
  } finally {
    rmSync(folder, {recursive: true, force: true});
  }
}

/** The processes that a process has started, and theirs. */
export function childrenOf(pid) {
  const parents = new Map();
  for (const name of readdirSync('/proc').filter((entry) => /^\d+$/.test(entry))) {
    try {
      const stat = readFileSync(`/proc/${name}/stat`, 'utf8');
      parents.set(Number(name), Number(stat.slice(stat.lastIndexOf(')') + 2).split(' ')[1]));
    } catch {
      continue; // it has ended meanwhile
    }
  }
  const found = [], add = (parent) => parents.forEach((of, child) => of === parent && (found.push(child), add(child)));
  add(pid);
  return found;
}

/** The run that a server has begun, once it is there: the page says that it makes something before that. */
export async function runOf(pid) {
  for (const until = Date.now() + 60_000; Date.now() < until;) {
    const run = childrenOf(pid).find((child) => {
      try {
        return readFileSync(`/proc/${child}/cmdline`, 'latin1').split('\0')[1] === 'run';
      } catch {
        return false; // it has ended meanwhile
      }
    });
    if (run) return run;
    await new Promise((resolve) => setTimeout(resolve, 20));
  }
  throw new Error('no run has begun');
}

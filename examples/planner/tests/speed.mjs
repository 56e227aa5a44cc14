// Prints how fast the page is: first picture, time from a change of a form to the shape, the leak and all figures, and
// frames and tasks of the main thread while a valve settles. Usage: node tests/speed.mjs [VERTICES ...]; the default
// is 425 1700 3500, of which the last has 7,000 faces.
import { mkdtempSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { closed, openBrowser, page_path } from './browser.mjs';
import { begin, open } from './person.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const library = resolve(here, '../../../build/js/dist/index.mjs');
const sizes = process.argv.slice(2).map(Number);
const rounds = 9;

/** The OBJ file of the shipped valve with about this many vertices. */
async function valveFile(vertices) {
  const { loadMvs } = await import(pathToFileURL(library).href);
  const mvs = await loadMvs();
  const sim = mvs.simulator();
  sim.generateValve({ vertices });
  const [bytes, faces] = sim.read((snapshot) => [
    snapshot.save('obj'),
    snapshot.view('triangle_nodes').count,
  ]);
  sim.dispose();
  const path = join(mkdtempSync(join(tmpdir(), 'speed-')), `valve${vertices}.obj`);
  writeFileSync(path, bytes);
  return { path, faces };
}

const sorted = (values) => [...values].sort((a, b) => a - b);
const share = (values, s) =>
  sorted(values)[Math.min(values.length - 1, Math.floor(s * values.length))] ?? NaN;
const ms = (value) => `${value.toFixed(0).padStart(6)} ms`;

/** Installs clocks in the page: changes of forms, stages of previews as drawn, frames, long tasks. */
function installClocks(page) {
  return page.evaluate(() => {
    const clocks = { changed: 0, stages: [], frames: [], tasks: [], settling: false };
    window.clocks = clocks;
    addEventListener('input', () => (clocks.changed = performance.now()), true);
    const { state } = window.planner;
    state.preview.subscribe((preview) => {
      if (!preview || !clocks.changed) return;
      const { known = 'all' } = preview.figures;
      const from = clocks.changed;
      // drawn at the end of the next frame
      requestAnimationFrame(() =>
        requestAnimationFrame(() => clocks.stages.push({ known, from, time: performance.now() - from })),
      );
    });
    let last = 0;
    const frame = (now) => {
      if (clocks.settling && last) clocks.frames.push(now - last);
      last = now;
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
    new PerformanceObserver((list) => {
      if (clocks.settling) clocks.tasks.push(...list.getEntries().map((entry) => entry.duration));
    }).observe({ entryTypes: ['longtask'] });
  });
}

/** Moves the slider of a form by keys; returns the times to each stage of the preview. */
async function previews(page) {
  await begin(page, 'annulus_scale');
  await page.locator('.form input[type=range]').first().focus();
  await page.evaluate(() => (window.clocks.settling = true));
  const before = browserCpu();
  for (let k = 0; k < rounds; ++k) {
    await page.keyboard.press(k % 2 ? 'ArrowRight' : 'ArrowLeft');
    await page.waitForTimeout(60);
    await closed(page);
    await page.waitForTimeout(120);
  }
  const cpu = (browserCpu() - before) / rounds;
  const { stages, frames, tasks } = await page.evaluate(() => {
    window.clocks.settling = false;
    return window.clocks;
  });
  const last = (known) => {
    const times = new Map();
    for (const stage of stages) if (stage.known === known) times.set(stage.from, stage.time);
    return [...times.values()];
  };
  return { shape: last('shape'), orifice: last('orifice'), all: last('all'), frames, tasks, cpu };
}

/** CPU time, ms, of this process's children and theirs: the browser. From /proc of Linux, in ticks of 10 ms. */
function browserCpu() {
  const parents = new Map();
  const times = new Map();
  for (const name of readdirSync('/proc')) {
    if (!/^\d+$/.test(name)) continue;
    try {
      const words = readFileSync(`/proc/${name}/stat`, 'utf8')
        .replace(/^.*\) /, '')
        .split(' ');
      parents.set(name, words[1]);
      times.set(name, 10 * (Number(words[11]) + Number(words[12])));
    } catch {
      // a process that has ended
    }
  }
  const isOurs = (name) => {
    for (let at = parents.get(name); at && at !== '0'; at = parents.get(at))
      if (at === String(process.pid)) return true;
    return false;
  };
  let sum = 0;
  for (const [name, time] of times) if (isOurs(name)) sum += time;
  return sum;
}

async function measure(vertices) {
  const { path, faces } = await valveFile(vertices);
  const { context } = await openBrowser();
  try {
    const page = context.pages()[0] ?? (await context.newPage());
    const begun = performance.now();
    await page.goto(pathToFileURL(page_path).href);
    await page.evaluate(async () => {
      while (!window.planner?.state.picture.value) await new Promise((done) => setTimeout(done, 5));
      await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
    });
    const first = performance.now() - begun;
    await closed(page);
    await open(page, path);
    await closed(page, 300_000);
    await installClocks(page);
    const found = await previews(page);
    console.log(`${vertices} vertices, ${faces} faces`);
    console.log(`  first picture of the page        ${ms(first)}`);
    for (const [name, times] of [
      ['change to shape', found.shape],
      ['change to leak', found.orifice],
      ['change to all figures', found.all],
    ])
      console.log(
        `  ${name.padEnd(32)} ${ms(share(times, 0.5))}, worst ${ms(share(times, 1))} of ${times.length}`,
      );
    console.log(`  CPU of the browser per change    ${ms(found.cpu)}`);
    console.log(
      `  frame while it settles           ${ms(share(found.frames, 0.5))}, 95 % below ${ms(share(found.frames, 0.95))}`,
    );
    console.log(
      `  longest task of the main thread  ${ms(Math.max(0, ...found.tasks))}, ${found.tasks.length} above 50 ms`,
    );
  } finally {
    await context.close();
  }
}

for (const vertices of sizes.length ? sizes : [425, 1700, 3500]) await measure(vertices);

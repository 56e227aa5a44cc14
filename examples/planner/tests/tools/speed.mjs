// Prints how fast the page is: first picture, time from a change of a form to the shape, the leak and all figures, and
// frames and tasks of the main thread while a valve settles. CPU times hold on a busy machine as well (README.md). Usage:
// node tests/tools/speed.mjs [VERTICES ...]; the default is 425 1700 3710, of which the last has 7,000 faces.
import { mkdtempSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { closed, openBrowser, page_path } from '../fixtures/browser.mjs';
import { begin, open } from '../fixtures/person.mjs';
import { cpuBetween, traced } from '../fixtures/trace.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const library = resolve(here, '../../../../build/js/dist/index.mjs');
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

/** The value below which a share of the values lies. */
function quantile(values, share) {
  const sorted = [...values].sort((a, b) => a - b);
  return sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))] ?? NaN;
}
const ms = (value) => `${value.toFixed(0).padStart(6)} ms`;

/** Installs clocks in the page: marks of changes of the form and of stages as drawn, and frames. */
function installClocks(page) {
  return page.evaluate(() => {
    const frames = (window.frameTimes = []);
    addEventListener('input', () => performance.mark('changed'), true);
    addEventListener('keydown', ({ key }) => key === 'Enter' && performance.mark('pressed'), true);
    for (const [valve, prefix] of [
      ['preview', ''],
      ['main', 'applied '],
    ])
      window.planner.state[valve].subscribe((shown) => {
        const { known = 'all' } = shown?.figures ?? {};
        // drawn at the end of the next frame
        if (shown) requestAnimationFrame(() => requestAnimationFrame(() => performance.mark(prefix + known)));
      });
    let last = 0;
    const frame = (now) => {
      if (last) frames.push(now - last);
      last = now;
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  });
}

/** Moves the slider of a form by keys. */
async function changeForm(page) {
  for (let k = 0; k < rounds; ++k) {
    await page.keyboard.press(k % 2 ? 'ArrowRight' : 'ArrowLeft');
    await page.waitForTimeout(60);
    await closed(page);
    await page.waitForTimeout(150);
  }
}

/** Types a value, which Enter takes, and applies it by Enter, again and again on the valve that it makes. */
async function applyTyped(page) {
  for (let k = 0; k < rounds; ++k) {
    await begin(page, 'annulus_scale');
    await page.locator('#f-factor').fill(String(k % 2 ? 104 : 97));
    await page.keyboard.press('Enter');
    // nothing is applied before its result is shown
    while (await page.evaluate(() => window.planner.state.outdated.value)) await page.waitForTimeout(5);
    await page.keyboard.press('Enter');
    await page.getByTestId('form').waitFor({ state: 'detached' });
    await closed(page);
    await page.waitForTimeout(150);
  }
}

/** Times from each mark `from` to the first mark of a name: by the clock, and CPU of page and worker. */
function timesTo(from, name, { main, worker, marks }) {
  const changes = marks.filter((mark) => mark.name === from).map((mark) => mark.time);
  const found = [];
  changes.forEach((begin, k) => {
    const end = marks.find((m) => m.name === name && m.time > begin && m.time < (changes[k + 1] ?? Infinity));
    if (end)
      found.push({
        wall: end.time - begin,
        cpu: cpuBetween(main, begin, end.time) + cpuBetween(worker, begin, end.time),
      });
  });
  return found;
}

/** Prints the times of the stages after marks of one name. */
function reportStages(title, from, prefix, trace) {
  for (const [stage, name] of [
    ['shape', 'shape'],
    ['leak, coaptation', 'orifice'],
    ['all figures', 'all'],
  ]) {
    const times = timesTo(from, prefix + name, trace);
    const [cpu, wall] = [times.map((t) => t.cpu), times.map((t) => t.wall)];
    console.log(
      `  ${`${title} to ${stage}`.padEnd(32)} CPU ${ms(quantile(cpu, 0.5))}, clock ${ms(quantile(wall, 0.5))}, worst ${ms(quantile(wall, 1))} (${times.length})`,
    );
  }
}

/** Prints when each part of the page was there after it was opened, and the CPU of page and worker until then. */
function reportOpening({ main, worker, marks }) {
  const at = (name) => marks.find((mark) => mark.name === name).time;
  const begin = Math.max(
    ...marks
      .filter((mark) => mark.name === 'navigationStart' && mark.time < at('page script'))
      .map((m) => m.time),
  );
  for (const name of ['page script', 'first picture', 'library ready', 'closed valve']) {
    const end = at(name);
    console.log(
      `  ${`opening to ${name}`.padEnd(32)} CPU ${ms(cpuBetween(main, begin, end))} + ${ms(cpuBetween(worker, begin, end))}, clock ${ms(end - begin)}`,
    );
  }
}

function report(trace, frames) {
  reportStages('change', 'changed', '', trace);
  const cpu = trace.main.map((task) => task.cpu);
  console.log(
    `  longest task of the main thread  CPU ${ms(Math.max(...cpu))}, clock ${ms(Math.max(...trace.main.map((task) => task.wall)))}`,
  );
  console.log(
    `  frame while it settles               ${ms(quantile(frames, 0.5))}, 95 % below ${ms(quantile(frames, 0.95))}`,
  );
}

async function measure(vertices) {
  const { path, faces } = await valveFile(vertices);
  const { context } = await openBrowser();
  try {
    const page = context.pages()[0] ?? (await context.newPage());
    const opening = await traced(page, async () => {
      await page.goto(pathToFileURL(page_path).href);
      await closed(page);
      await page.waitForTimeout(200);
    });
    await open(page, path);
    await closed(page, 300_000);
    await installClocks(page);
    await begin(page, 'annulus_scale');
    await page.locator('.form input[type=range]').first().focus();
    await page.evaluate(() => (window.frameTimes.length = 0));
    const trace = await traced(page, () => changeForm(page));
    console.log(`${vertices} vertices, ${faces} faces`);
    reportOpening(opening);
    report(trace, await page.evaluate(() => window.frameTimes));
    await page.keyboard.press('Escape');
    reportStages('Enter', 'pressed', 'applied ', await traced(page, () => applyTyped(page)));
  } finally {
    await context.close();
  }
}

for (const vertices of sizes.length ? sizes : [425, 1700, 3710]) await measure(vertices);

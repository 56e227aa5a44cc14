// Opens the built page from disk in Debian's Chromium, as a person would; collects errors of the page.
import assert from 'node:assert/strict';
import { mkdtempSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { after, before } from 'node:test';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { chromium } from 'playwright-core';

export const page_path = resolve(
  process.env.PLANNER_PAGE ?? join(dirname(fileURLToPath(import.meta.url)), '../../../out/planner.html'),
);

const flags = [
  '--no-sandbox',
  '--disable-gpu',
  '--disable-quic',
  '--no-first-run',
  '--disable-background-networking',
  '--disable-component-update',
  '--disable-sync',
];

/** ms that a test waits for what the page does: other work on the machine may take most of it. */
const patience = 180_000;

/**
 * Installs `window.pixels(box)` in every page: the picture as it is drawn at rest, as ImageData; `box`: left, top, width and height
 * in CSS pixels of the picture.
 */
function installPixels() {
  window.pixels = async (box) => {
    const { viewport } = window.planner;
    const image = new Image();
    image.src = viewport.snapshot();
    await image.decode();
    const canvas = document.createElement('canvas');
    [canvas.width, canvas.height] = [image.width, image.height];
    const paint = canvas.getContext('2d');
    paint.drawImage(image, 0, 0);
    const scale = image.width / viewport.width;
    const all = [0, 0, viewport.width, viewport.height];
    return paint.getImageData(...(box ?? all).map((v) => Math.round(scale * v)));
  };
}

/**
 * A browser with a profile of its own, so that storage outlives the page. `software`: no WebGL; `zoom`: of the page, which has as
 * many fewer CSS pixels, each with as many more pixels.
 */
export async function openBrowser({
  width = 1280,
  height = 720,
  profile,
  touch = false,
  software = false,
  zoom = 1,
} = {}) {
  const folder = profile ?? mkdtempSync(join(tmpdir(), 'planner-'));
  const context = await chromium.launchPersistentContext(folder, {
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    headless: true,
    args: software ? [...flags, '--disable-3d-apis'] : flags,
    viewport: { width: Math.round(width / zoom), height: Math.round(height / zoom) },
    deviceScaleFactor: zoom,
    hasTouch: touch,
    acceptDownloads: true,
  });
  context.setDefaultTimeout(patience);
  await context.addInitScript(installPixels);
  return { context, profile: folder };
}

/** Opens the page and waits for the closed valve. */
export async function openPlanner(context, { hash = '' } = {}) {
  const page = context.pages()[0] ?? (await context.newPage());
  const errors = [];
  const requests = [];
  page.on('pageerror', (error) => errors.push(String(error)));
  page.on('console', (message) => message.type() === 'error' && errors.push(message.text()));
  page.on('request', (request) => {
    if (!/^(file|blob|data):/.test(request.url())) requests.push(request.url());
  });
  await page.goto(pathToFileURL(page_path).href + hash);
  await closed(page);
  return { page, errors, requests };
}

/** Waits until nothing is calculated and the valve is shown. The page's policy forbids waitForFunction (eval). */
export async function closed(page, limit = patience) {
  const end = Date.now() + limit;
  for (;;) {
    const idle = await page.evaluate(() => {
      const { state } = window.planner ?? {};
      const known = state?.main.value?.figures.known === 'all';
      return known && !state.busy.value && !(state.draft.value && state.pending.value);
    });
    if (idle) return;
    if (Date.now() > end) throw new Error(`the page is busy for more than ${limit / 1000} s`);
    await page.waitForTimeout(20);
  }
}

/** Lets the tab of a page die, as in a crash of the browser, and opens the page in another one. */
export async function reopenAfterCrash(page) {
  const context = page.context();
  const next = await context.newPage();
  const client = await context.newCDPSession(page);
  const crashed = page.waitForEvent('crash');
  // the answer never comes
  client.send('Page.crash').catch(() => {});
  await crashed;
  await next.goto(pathToFileURL(page_path).href);
  await closed(next);
  return next;
}

/** The figures of the valve on the page. */
export function figures(page) {
  return page.evaluate(() => {
    const { state } = window.planner;
    const shown = state.preview.value ?? state.main.value;
    const { fields: _, ...rest } = shown.figures;
    return rest;
  });
}

/** A file in a folder of its own; returns its path. */
export function temporaryFile(name, content) {
  const path = join(mkdtempSync(join(tmpdir(), 'planner-')), name);
  writeFileSync(path, content);
  return path;
}

/** A page for one test, which must have no errors. */
export async function withPlanner(options, work) {
  const { context, profile } = await openBrowser(options);
  try {
    const opened = await openPlanner(context, options);
    await work({ ...opened, context, profile });
    assert.deepEqual(opened.errors, []);
  } finally {
    await context.close();
  }
}

/**
 * One page for all tests of a suite, which `take` receives before the first of them and which must have no errors but
 * those that the test `expects`. `prepare` gets the browser before the page is opened.
 */
export function sharePlanner(take, { prepare = async () => {}, expects = () => false } = {}) {
  let context;
  let errors = [];
  before(async () => {
    ({ context } = await openBrowser());
    await prepare(context);
    const opened = await openPlanner(context);
    errors = opened.errors;
    take({ context, ...opened });
  });
  after(async () => {
    await context?.close();
    assert.deepEqual(
      errors.filter((text) => !expects(text)),
      [],
    );
  });
}

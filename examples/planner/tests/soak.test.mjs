// Random events: the page makes no error, loses no memory, and its valve stays at rest. The events follow a seed.
import assert from 'node:assert/strict';
import { describe, it } from 'node:test';
import { closed, figures, openBrowser, openPlanner } from './fixtures/browser.mjs';

const events = Number(process.env.PLANNER_EVENTS ?? 10_000);
const seed = Number(process.env.PLANNER_SEED ?? 1);

/** Park and Miller's generator. */
function generator(start) {
  let state = start % 2147483647 || 1;
  return () => (state = (state * 48271) % 2147483647) / 2147483647;
}

const keys = [
  '1',
  '2',
  '3',
  '4',
  'v',
  'r',
  'p',
  'l',
  'o',
  'x',
  'c',
  'n',
  'm',
  'g',
  'b',
  'Escape',
  'Enter',
  'Tab',
  'ArrowLeft',
  'ArrowUp',
  'Control+z',
  'Control+y',
  '+',
  '-',
  'Space',
  'Backspace',
  'Control+ArrowRight',
  'q',
  'e',
  'a',
  'd',
];

async function event(page, random) {
  const { width, height } = page.viewportSize();
  const [x, y] = [random() * width, random() * height];
  const kind = random();
  if (kind < 0.4) await page.keyboard.press(keys[Math.floor(random() * keys.length)]);
  else if (kind < 0.7) await page.mouse.click(x, y);
  else if (kind < 0.8) await page.mouse.wheel(0, 400 * (random() - 0.5));
  else {
    await page.mouse.move(x, y);
    await page.mouse.down();
    for (let k = 0; k < 4; ++k) await page.mouse.move(x + 120 * (random() - 0.5), y + 120 * (random() - 0.5));
    await page.mouse.up();
  }
}

describe('soak', () => {
  it(`stays_without_error_over_${events}_random_events`, async () => {
    const { context } = await openBrowser();
    try {
      const { page, errors, requests } = await openPlanner(context);
      // a file dialog would wait for a person
      page.on('filechooser', () => {});
      const random = generator(seed);
      const heap = async () => {
        const client = await context.newCDPSession(page);
        await client.send('HeapProfiler.collectGarbage');
        return (await client.send('Runtime.getHeapUsage')).usedSize;
      };
      for (let k = 0; k < events / 4; ++k) await event(page, random);
      const early = await heap();
      for (let k = events / 4; k < events; ++k) await event(page, random);
      await page.evaluate(() => (window.planner.state.dialog.value = null));
      await closed(page, 120_000);
      assert.deepEqual(errors, []);
      assert.deepEqual(requests, []);
      const found = await figures(page);
      assert.equal(found.measures.crossings, 0);
      assert.ok(found.measures.atRest);
      // the history and some topologies grow with the operations; a leak of pictures would be hundreds of MB
      assert.ok((await heap()) < early + 60e6, `${early} to ${await heap()} bytes`);
    } finally {
      await context.close();
    }
  });
});

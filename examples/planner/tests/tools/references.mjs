// Pictures of the rasteriser to compare with. Usage: node tests/tools/references.mjs makes tests/references/*.png anew from
// out/planner.html; look at them before they are committed.
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { closed, openBrowser, openPlanner } from '../fixtures/browser.mjs';
import { apply, begin, cameraRests, openPanel } from '../fixtures/person.mjs';

const folder = join(dirname(fileURLToPath(import.meta.url)), '../references');

/** CSS pixels of the picture, whatever the fonts of the machine leave for it. */
const [width, height] = [200, 150];

async function tourValve(page, number) {
  await openPanel(page, 'Learn');
  await page.getByRole('button', { name: `Valve ${number}` }).click();
  await page.getByText(`Valve ${number} of the tour`).waitFor();
  await closed(page);
}

async function look(page, key) {
  await page.keyboard.press(key);
  await cameraRests(page);
}

/** The pictures by name, in the order in which they are reached. */
const shots = {
  healthy_atrium: (page) => look(page, '1'),
  healthy_ventricle: (page) => look(page, '2'),
  healthy_section: (page) => look(page, '4'),
  healthy_stretch: async (page) => {
    await page.keyboard.press('x');
    await look(page, '1');
    await page.getByLabel('Colours').selectOption({ label: 'Leaflet stretch' });
  },
  ring: async (page) => {
    await page.getByLabel('Colours').selectOption({ label: 'Tissue' });
    await begin(page, 'ring');
    await apply(page);
    await look(page, '3');
  },
  leak_atrium: async (page) => {
    await tourValve(page, 3);
    await look(page, '1');
  },
  leak_ventricle: (page) => look(page, '2'),
};

/** Draws all pictures; each as a data URL, by its name. */
export async function drawPictures() {
  const { context } = await openBrowser();
  try {
    const { page } = await openPlanner(context, { hash: '#software' });
    await page.evaluate(
      ([w, h]) =>
        Object.assign(window.planner.viewport.host.style, {
          inset: 'auto',
          width: `${w}px`,
          height: `${h}px`,
        }),
      [width, height],
    );
    const pictures = {};
    for (const [name, reach] of Object.entries(shots)) {
      await reach(page);
      await page.waitForTimeout(200);
      pictures[name] = await page.evaluate(() => window.planner.viewport.snapshot());
    }
    return pictures;
  } finally {
    await context.close();
  }
}

const start = 'data:image/png;base64,';
const fileOf = (name) => join(folder, `${name}.png`);
export const readReference = (name) => start + readFileSync(fileOf(name)).toString('base64');

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  mkdirSync(folder, { recursive: true });
  for (const [name, url] of Object.entries(await drawPictures()))
    writeFileSync(fileOf(name), Buffer.from(url.slice(start.length), 'base64'));
  console.log(`wrote ${Object.keys(shots).length} pictures to ${folder}`);
}

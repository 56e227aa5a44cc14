// Makes examples/pictures/planner.png: the tour as a strip of four pictures of the page. Usage: node tests/tools/pictures.mjs
import { mkdtempSync, readFileSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { openBrowser, openPlanner } from '../fixtures/browser.mjs';
import { answered, apply, begin, cameraRests, openPanel } from '../fixtures/person.mjs';

const target = resolve(dirname(fileURLToPath(import.meta.url)), '../../../pictures/planner.png');
const size = { width: 1280, height: 720 };
const { context } = await openBrowser(size);
const shots = [];
try {
  const { page } = await openPlanner(context);
  const shoot = async () => {
    await cameraRests(page);
    await page.mouse.move(2, 2);
    // a focused control shows its tooltip
    await page.evaluate(() => document.activeElement?.blur());
    await page.waitForTimeout(800);
    shots.push(readFileSync(await save(await page.screenshot())));
  };
  const save = async (bytes) => {
    const path = join(mkdtempSync(join(tmpdir(), 'picture-')), 'shot.png');
    writeFileSync(path, bytes);
    return path;
  };
  await openPanel(page, 'Learn');
  await page.getByRole('button', { name: 'Valve 1' }).click();
  await answered(page, 200);
  await page.getByTestId('score').getByText('Study surgeon').waitFor();
  await shoot();
  await page.keyboard.press('2');
  await begin(page, 'band');
  await page.locator('#f-factor').fill('85');
  await page.keyboard.press('Tab');
  await answered(page, 200);
  await shoot();
  await apply(page);
  await page.keyboard.press('4');
  await openPanel(page, 'Valve');
  await page.selectOption('.viewbar select', 'coaptation');
  await shoot();
  await page.keyboard.press('x');
  await page.selectOption('.viewbar select', 'tissue');
  await page.keyboard.press('1');
  await openPanel(page, 'Learn');
  await page.getByText('All goals reached.').waitFor();
  await shoot();
  // four pictures in a square, at half size, put together by the browser
  const page2 = await context.newPage();
  await page2.setViewportSize({ width: size.width, height: size.height });
  const images = shots
    .map((bytes) => `<img src="data:image/png;base64,${bytes.toString('base64')}">`)
    .join('');
  await page2.setContent(
    `<style>body{margin:0;display:grid;grid-template-columns:1fr 1fr;gap:4px;background:#8795a1}img{width:100%;display:block}</style>${images}`,
  );
  await page2.waitForTimeout(300);
  writeFileSync(target, await page2.screenshot());
} finally {
  await context.close();
}
console.log(`wrote ${target}`);

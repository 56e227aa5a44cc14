// Actions of a person on the page: look, point, press, type.
import { closed } from './browser.mjs';

export async function openPanel(page, name) {
  await page.getByRole('tab', { name }).click();
}

export async function begin(page, kind) {
  await openPanel(page, 'Repair');
  const card = page.locator(`[data-operation=${kind}]`);
  if (!(await card.isVisible())) await page.getByText('More operations').click();
  await card.click();
  await closed(page);
}

/** Presses Tab until an element has the focus, by its id, operation, label or text. */
export async function tabTo(page, wanted) {
  for (let k = 0; k < 80; ++k) {
    await page.keyboard.press('Tab');
    const text = await page.evaluate(() => {
      const { activeElement: e } = document;
      const label = e?.labels?.[0]?.textContent ?? e?.ariaLabel ?? '';
      return `${e?.id} ${e?.getAttribute('data-operation') ?? ''} ${label} ${e?.textContent ?? ''}`;
    });
    if (wanted.test(text)) return;
  }
  throw new Error(`the keyboard does not reach ${wanted}`);
}

/** Opens the form of an operation by keys. */
export async function openForm(page, operation) {
  await page.keyboard.press('r');
  await tabTo(page, operation);
  await page.keyboard.press('Enter');
}

/** The name of what the keyboard goes to, and whether something covers it or it is out of the window. */
export function focused(page) {
  return page.evaluate(() => {
    const element = document.activeElement;
    const box = element.getBoundingClientRect();
    const on = document.elementFromPoint(box.left + box.width / 2, box.top + box.height / 2);
    const seen = !!on && (on === element || element.contains(on) || on.contains(element));
    return {
      name: element.ariaLabel || element.labels?.[0]?.textContent || element.textContent || element.tagName,
      covered: seen ? '' : `at ${Math.round(box.left)}, ${Math.round(box.top)}`,
    };
  });
}

export async function apply(page) {
  await closed(page);
  await page.getByRole('button', { name: 'Apply', exact: true }).click();
  await page.getByTestId('form').waitFor({ state: 'detached' });
  await closed(page);
}

/** Pixel of a chord's middle and of its ends in the window, if the picture shows them. */
export function chordPlace(page, name) {
  return page.evaluate((wanted) => {
    const { state, viewport } = window.planner;
    const picture = state.picture.value;
    const topology = state.topologyOf(picture);
    const k = topology.chords.findIndex((part) => part.name === wanted);
    const box = viewport.renderer.canvas.getBoundingClientRect();
    const at = (node) => {
      const [x, y] = viewport.camera.project(
        ...picture.positions.slice(3 * node, 3 * node + 3),
        viewport.width,
        viewport.height,
      );
      return { x: box.left + x, y: box.top + y };
    };
    const [head, leaf] = [at(topology.chordNodes[2 * k]), at(topology.chordNodes[2 * k + 1])];
    const middle = (s) => ({ x: head.x + s * (leaf.x - head.x), y: head.y + s * (leaf.y - head.y) });
    return { head, leaf, middle: middle(0.5), places: [0.2, 0.35, 0.5, 0.65].map(middle) };
  }, name);
}

/**
 * The pixel of a triangle of a scallop that has a side on the free edge, a share of the way from left to right.
 */
export function edgePlace(page, scallop, along) {
  return page.evaluate(
    ([name, share]) => {
      const { state, viewport } = window.planner;
      const picture = state.picture.value;
      const topology = state.topologyOf(picture);
      const wanted = topology.scallops.findIndex((part) => part.name === name);
      const free = new Set(topology.freeEdge);
      const box = viewport.renderer.canvas.getBoundingClientRect();
      const places = [];
      topology.triangleScallop.forEach((which, t) => {
        const nodes = [...topology.triangles.slice(3 * t, 3 * t + 3)];
        if (which !== wanted || nodes.filter((node) => free.has(node)).length < 2) return;
        const at = [0, 1, 2].map((c) =>
          nodes.reduce((sum, node) => sum + picture.positions[3 * node + c] / 3, 0),
        );
        const [x, y] = viewport.camera.project(...at, viewport.width, viewport.height);
        places.push({ x: box.left + x, y: box.top + y });
      });
      places.sort((a, b) => a.x - b.x);
      return places[Math.round(share * (places.length - 1))];
    },
    [scallop, along],
  );
}

/** The pixel of a papillary head's drawn middle in the window. */
export function headPlace(page, name) {
  return page.evaluate((wanted) => {
    const { state, viewport } = window.planner;
    const picture = state.picture.value;
    const topology = state.topologyOf(picture);
    const node = topology.headNodes[topology.heads.findIndex((part) => part.name === wanted)];
    const up = viewport.frameOf().slice(9, 12);
    const at = [0, 1, 2].map((c) => picture.positions[3 * node + c] - 4.5 * up[c]);
    const box = viewport.renderer.canvas.getBoundingClientRect();
    const [x, y] = viewport.camera.project(...at, viewport.width, viewport.height);
    return { x: box.left + x, y: box.top + y };
  }, name);
}

/** Names of all chordae of the valve. */
export function chordNames(page) {
  return page.evaluate(() => window.planner.state.main.value.figures.chords.map((chord) => chord.name));
}

/** Clicks on chordae until one is chosen; returns its name and the place that was clicked. */
export async function chooseAnyChord(page, names) {
  for (const name of names) {
    const { places } = await chordPlace(page, name);
    for (const place of places) {
      await page.mouse.click(place.x, place.y);
      const chosen = await page.evaluate(() => {
        const { state } = window.planner;
        const { value } = state.choice;
        return value?.kind === 'chord'
          ? state.main.value.figures.chords.find((chord) => chord.id === value.id)?.name
          : '';
      });
      if (chosen === name) return { name, place };
    }
  }
  throw new Error('no chord could be chosen by a click');
}

/** Waits until the camera rests. */
export async function cameraRests(page) {
  let old = '';
  for (let k = 0; k < 100; ++k) {
    await page.waitForTimeout(60);
    const now = await page.evaluate(() =>
      JSON.stringify([
        window.planner.viewport.camera.orientation.toArray(),
        window.planner.viewport.camera.distance,
      ]),
    );
    if (now === old) return;
    old = now;
  }
}

/** Waits for the answer to what was just done. */
export async function answered(page, reaction = 50) {
  await page.waitForTimeout(reaction);
  await closed(page);
}

/** Leaves forms and notices, and looks at the valve as the surgeon does. */
export async function startAfresh(page) {
  await page.keyboard.press('Escape');
  await page.evaluate(() => (window.planner.state.notice.value = null));
  await page.keyboard.press('1');
  await cameraRests(page);
}

export async function undo(page) {
  await page.keyboard.press('Control+z');
  await answered(page);
}

/**
 * The share of the picture that shows tissue, which is redder than blue by `margin` of 255; chordae and background are
 * not. `box`: left, top, width, height as shares of the picture.
 */
export function shareOfTissue(page, { box = [0, 0, 1, 1], margin = 20 } = {}) {
  return page.evaluate(
    async ([shares, least]) => {
      const { width, height } = window.planner.viewport;
      const { data } = await window.pixels(shares.map((s, k) => s * (k % 2 ? height : width)));
      let tissue = 0;
      for (let i = 0; i < data.length; i += 4) tissue += data[i] > data[i + 2] + least ? 1 : 0;
      return tissue / (data.length / 4);
    },
    [box, margin],
  );
}

export async function save(page) {
  const [download] = await Promise.all([page.waitForEvent('download'), page.keyboard.press('Control+s')]);
  await closed(page);
  return download.path();
}

/** Opens a file as the dialog would. */
export async function open(page, path) {
  await page.setInputFiles('#file', path);
  await answered(page, 150);
}

/** The open leaflets of the valve as OBJ, as another program writes a surface; `axes`: the coordinates in their order there. */
export async function openLeaflets(page, axes = [0, 1, 2]) {
  await page.keyboard.press('o');
  for (let k = 0; k < 200 && !(await page.evaluate(() => !!window.planner.state.motion.value)); ++k)
    await page.waitForTimeout(50);
  return page.evaluate((order) => {
    const { state } = window.planner;
    const { picture } = state.motion.value;
    const { triangles } = state.topologyOf(picture);
    let obj = '';
    for (let i = 0; i < picture.positions.length; i += 3)
      obj += `v ${order.map((axis) => picture.positions[i + axis]).join(' ')}\n`;
    for (let i = 0; i < triangles.length; i += 3)
      obj += `f ${[...triangles.slice(i, i + 3)].map((node) => node + 1).join(' ')}\n`;
    return obj;
  }, axes);
}

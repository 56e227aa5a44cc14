// A click chooses the part drawn under it: the pixels of the picture are the reference, not the code that picks. The chosen part
// is dragged where it is drawn.
import assert from 'node:assert/strict';
import { describe, it } from 'node:test';
import { withPlanner } from './fixtures/browser.mjs';
import { answered, apply, cameraRests, chordPlace, openPanel } from './fixtures/person.mjs';

/**
 * Places in the window whose pixels, with all their neighbours within 2, show a papillary head or a chord, by their
 * colours in src/view/colours.ts, which the light scales: heads are brown (0.4, 0.19, 0.16), chordae cream
 * (0.95, 0.91, 0.8), the atrial sides of the leaflets (0.93, 0.74, 0.66) and (0.89, 0.66, 0.6). `free`: places in the background with no other colour within 30 pixels but a head, which begins
 * 6 to 10 pixels away.
 */
function drawnParts(page) {
  return page.evaluate(async () => {
    const { viewport } = window.planner;
    const { data, width, height } = await window.pixels();
    // the picture has more pixels than the window
    const scale = width / viewport.width;
    const kinds = new Uint8Array(width * height);
    const [other, background, head, chord, atrial] = [0, 1, 2, 3, 4];
    for (let k = 0; k < kinds.length; ++k) {
      const [r, g, b] = [data[4 * k], data[4 * k + 1], data[4 * k + 2]];
      if (r < g && g < b && b - r < 12) kinds[k] = background;
      else if (r > 1.9 * g && r < 2.3 * g && g > 1.1 * b && g < 1.4 * b) kinds[k] = head;
      else if (r >= g && r < 1.1 * g && g > b && r > 1.12 * b && r < 1.4 * b) kinds[k] = chord;
      else if (r > 1.2 * g && r < 1.45 * g && r > 1.35 * b && r < 1.6 * b) kinds[k] = atrial;
      else kinds[k] = other;
    }
    const around = (x, y, beside, allowed) => {
      const reach = Math.round(scale * beside);
      for (let v = y - reach; v <= y + reach; ++v)
        for (let u = x - reach; u <= x + reach; ++u)
          if (u < 0 || v < 0 || u >= width || v >= height || !allowed.includes(kinds[v * width + u]))
            return false;
      return true;
    };
    const near = (x, y, beside) => {
      const reach = Math.round(scale * beside);
      for (let v = Math.max(0, y - reach); v <= Math.min(height - 1, y + reach); ++v)
        for (let u = Math.max(0, x - reach); u <= Math.min(width - 1, x + reach); ++u)
          if (kinds[v * width + u] === head && Math.hypot(u - x, v - y) <= reach) return true;
      return false;
    };
    const box = viewport.renderer.canvas.getBoundingClientRect();
    const out = { heads: [], chordae: [], free: [], atrial: [] };
    const add = (list, x, y) => {
      const at = { x: box.left + (x + 0.5) / scale, y: box.top + (y + 0.5) / scale };
      // apart from each other, so that they are not all on one part
      if (list.every((place) => Math.hypot(place.x - at.x, place.y - at.y) > 9)) list.push(at);
    };
    for (let y = 0; y < height; ++y)
      for (let x = 0; x < width; ++x) {
        const kind = kinds[y * width + x];
        if (kind === atrial && around(x, y, 2, [atrial])) add(out.atrial, x, y);
        else if (kind === head && around(x, y, 2, [head])) add(out.heads, x, y);
        else if (kind === chord && around(x, y, 1, [chord]) && near(x, y, 40)) add(out.chordae, x, y);
        else if (kind === background && x % 4 === 0 && near(x, y, 10) && !near(x, y, 6))
          if (around(x, y, 30, [background, head])) add(out.free, x, y);
      }
    return out;
  });
}

/** Presses at places; those of them, in words, that choose something else than the kind. */
async function wrongAt(page, places, kind, press) {
  const wrong = [];
  for (const place of places) {
    await page.evaluate(() => (window.planner.state.choice.value = null));
    await press(place);
    const chosen = await page.evaluate(() => window.planner.state.choice.value?.kind ?? 'nothing');
    if (chosen !== kind) wrong.push(`${chosen} at ${Math.round(place.x)}, ${Math.round(place.y)}`);
  }
  return wrong;
}

/** At most `count` of the places, from all over the list. */
const some = (places, count) =>
  places.filter((_, k) => k % Math.max(1, Math.ceil(places.length / count)) === 0);

const fine = { name: 'mouse', options: {}, press: (page) => (at) => page.mouse.click(at.x, at.y) };
const finger = {
  name: 'finger',
  options: { width: 820, height: 1180, touch: true },
  press: (page) => (at) => page.touchscreen.tap(at.x, at.y),
};

describe('planner, picking', () => {
  for (const { name, options, press } of [fine, finger])
    it(`chooses_the_chord_or_the_head_that_is_drawn_under_a_${name}`, async () => {
      await withPlanner(options, async ({ page }) => {
        // the panel that a choice opens may change the size of the picture
        await page.keyboard.press('r');
        let [seen, beside] = [0, 0];
        for (const view of ['2', '3']) {
          await page.keyboard.press(view);
          await cameraRests(page);
          const { heads, chordae, free } = await drawnParts(page);
          const wrong = (places, kind) => wrongAt(page, some(places, 15), kind, press(page));
          assert.deepEqual(await wrong(heads, 'head'), [], `heads in view ${view}`);
          assert.deepEqual(await wrong(chordae, 'chord'), [], `chordae in view ${view}`);
          seen += some(chordae, 15).length;
          // a finger that lands beside a head, where there is nothing else, means the head
          if (name !== 'finger') continue;
          assert.deepEqual(await wrong(free, 'head'), [], `beside heads in view ${view}`);
          beside += some(free, 15).length;
        }
        assert.ok(seen >= 10, `${seen} places on chordae`);
        assert.ok(name !== 'finger' || beside >= 3, `${beside} places beside heads`);
      });
    });

  for (const { name, options, press } of [fine, finger])
    it(`chooses_no_chord_through_the_leaflets_with_a_${name}`, async () => {
      await withPlanner(options, async ({ page }) => {
        await page.keyboard.press('r');
        await page.keyboard.press('1');
        await cameraRests(page);
        const { atrial } = await drawnParts(page);
        const places = some(atrial, 60);
        assert.ok(places.length > 40, `${places.length} places on the leaflets`);
        assert.deepEqual(await wrongAt(page, places, 'scallop', press(page)), []);
      });
    });

  it('drags_the_chosen_chord_through_what_hides_it_and_drops_it_when_it_is_cut', async () => {
    await withPlanner({}, async ({ page }) => {
      // from the atrium the leaflets hide all chordae, and the chosen one shines through
      await page.keyboard.press('1');
      await cameraRests(page);
      await openPanel(page, 'Repair');
      const blue = () =>
        page.evaluate(() => {
          const chosen = (m, i) =>
            m.front[i] < 0.02 && Math.abs(m.front[i + 1] - 0.62) < 0.02 && m.front[i + 2] > 0.98;
          return window.planner.viewport
            .scene()
            .meshes.some((m) => Array.from(m.front.keys()).some((i) => i % 3 === 0 && chosen(m, i)));
        });
      for (const k of [2, 11, 20]) {
        const { id, name, rest } = await page.evaluate((n) => {
          const chord = window.planner.state.main.value.figures.chords[n];
          window.planner.state.choice.value = { kind: 'chord', id: chord.id };
          return chord;
        }, k);
        const { head, leaf, middle } = await chordPlace(page, name);
        const length = Math.hypot(leaf.x - head.x, leaf.y - head.y);
        const [dx, dy] = [(leaf.x - head.x) / length, (leaf.y - head.y) / length];
        await page.mouse.move(middle.x, middle.y);
        await page.mouse.down();
        await page.mouse.move(middle.x - 30 * dx, middle.y - 30 * dy, { steps: 6 });
        await page.mouse.up();
        await answered(page, 300);
        const draft = await page.evaluate(() => window.planner.state.draft.value);
        assert.equal(draft?.kind, 'chord_length', name);
        assert.equal(draft.fields.chord, id);
        assert.ok(draft.fields.length < rest, `${name}: ${draft.fields.length} of ${rest} mm`);
        await page.keyboard.press('Escape');
        await answered(page, 300);
      }
      assert.ok(await blue());
      await page.getByRole('button', { name: 'Cut', exact: true }).click();
      await answered(page, 300);
      assert.ok(await blue(), 'what the operation removes is shown');
      await apply(page);
      assert.ok(!(await blue()), 'it is gone');
    });
  });
});

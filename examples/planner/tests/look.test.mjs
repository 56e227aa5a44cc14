// The picture and its labels: before and after, names beside their parts, views of a surface, the printed report.
import assert from 'node:assert/strict';
import { describe, it } from 'node:test';
import { sharePlanner, temporaryFile } from './fixtures/browser.mjs';
import { holdAnswers } from './fixtures/hold.mjs';
import {
  answered,
  apply,
  begin,
  cameraRests,
  chordNames,
  chordPlace,
  open,
  openLeaflets,
  openPanel,
  undo,
} from './fixtures/person.mjs';

/** Whether a line meets a box, by its points. */
function passes(a, b, box) {
  for (let s = 0; s <= 1; s += 1 / 256) {
    const [x, y] = [a.x + s * (b.x - a.x), a.y + s * (b.y - a.y)];
    if (x > box.x && x < box.x + box.width && y > box.y && y < box.y + box.height) return true;
  }
  return false;
}

describe('planner to look at', () => {
  let page;
  sharePlanner((opened) => ({ page } = opened), {
    prepare: (context) => context.addInitScript(holdAnswers),
  });
  const positions = (name) =>
    page.evaluate((which) => [...window.planner.state[which].value.picture.positions], name);
  const shown = () => page.evaluate(() => [...window.planner.state.picture.value.positions]);

  it('puts_the_name_of_a_chord_beside_all_chordae', async () => {
    await page.keyboard.press('2');
    await cameraRests(page);
    const names = await chordNames(page);
    const places = [];
    for (const name of names) places.push(await chordPlace(page, name));
    for (const name of names.filter((_, k) => k % 9 === 0)) {
      await page.evaluate((wanted) => {
        const { state } = window.planner;
        const { id } = state.main.value.figures.chords.find((chord) => chord.name === wanted);
        state.choice.value = { kind: 'chord', id };
      }, name);
      const label = page.locator('.label-chord', { hasText: `${name} ` });
      await label.waitFor();
      await page.waitForTimeout(250);
      const box = await label.boundingBox();
      const covered = places.filter(({ head, leaf }) => passes(head, leaf, box)).length;
      assert.ok(covered === 0, `the label of ${name} covers ${covered} chordae`);
    }
    await page.evaluate(() => (window.planner.state.choice.value = null));
  });

  it('shows_no_chord_between_the_leaflets_of_a_sealed_valve', async () => {
    await page.keyboard.press('1');
    await cameraRests(page);
    assert.equal(await page.evaluate(() => window.planner.state.main.value.figures.measures.orifice), 0);
    // pixels inside the annulus that chordae change
    const changed = () =>
      page.evaluate(async () => {
        const { state } = window.planner;
        const pixels = async () => new Uint32Array((await window.pixels()).data.buffer);
        const on = await pixels();
        state.chordsOn.value = false;
        const off = await pixels();
        state.chordsOn.value = true;
        return on.reduce((sum, pixel, k) => sum + (pixel !== off[k] ? 1 : 0), 0);
      });
    assert.equal(await changed(), 0);
    // the picture does show them where the leaflets do not hide them
    await page.keyboard.press('2');
    await cameraRests(page);
    assert.ok((await changed()) > 1000);
    await page.keyboard.press('1');
    await cameraRests(page);
  });

  it('writes_unit_and_limit_beside_the_colours_of_chordae', async () => {
    const scale = () => page.getByTestId('scale').innerText();
    const choose = (name) => page.getByLabel('Colours').selectOption({ label: name });
    await choose('Chord pull');
    assert.match(await scale(), /mN[^]*2000[^]*Limit: 800\smN, 2000\smN for strut/);
    await choose('Chord stretch');
    assert.match(await scale(), /%[^]*12[^]*Limit: 11\.1\s%/);
    await choose('Chord load');
    assert.match(await scale(), /100\s% is a pull of 800\smN, .*or a stretch of 11\.1\s%/);
    await choose('Tissue');
    // the card of a chord gives both beside their limits
    await page.evaluate(() => {
      const { state } = window.planner;
      const { id } = state.main.value.figures.chords.find(({ tension }) => tension > 0.1);
      state.choice.value = { kind: 'chord', id };
    });
    await openPanel(page, 'Repair');
    const card = await page.locator('.chosen-card').first().innerText();
    assert.match(card, /\d{3}\smN limit (800|2000)\smN/);
    assert.match(card, /\d\s% limit 11\.1\s%/);
    await page.evaluate(() => (window.planner.state.choice.value = null));
  });

  it('holds_an_annulus_that_grows_unless_the_picture_was_drawn_nearer', async () => {
    const outside = () =>
      page.evaluate(() => {
        const { state, viewport } = window.planner;
        const { value: picture } = state.picture;
        const { width, height, camera } = viewport;
        return [...state.topologyOf(picture).annulus].filter((node) => {
          const place = picture.positions.slice(3 * node, 3 * node + 3);
          const [x, y] = camera.project(...place, width, height);
          return x < 0 || y < 0 || x > width || y > height;
        }).length;
      });
    const distance = () => page.evaluate(() => window.planner.viewport.camera.distance);
    await page.keyboard.press('1');
    await cameraRests(page);
    const near = await distance();
    await begin(page, 'annulus_scale');
    for (const percent of ['120', '150']) {
      await page.locator('#f-factor').fill(percent);
      await page.keyboard.press('Tab');
      await answered(page, 300);
      await cameraRests(page);
      assert.equal(await outside(), 0, `the preview at ${percent} %`);
    }
    assert.ok((await distance()) > near);
    await page.locator('.viewbar').getByRole('button', { name: 'Surgeon' }).click();
    await cameraRests(page);
    assert.equal(await outside(), 0, 'the preview in the view that was asked for');
    await page.getByRole('button', { name: 'Discard' }).click();
    // who looks at a part from near stays there
    await page.keyboard.press('1');
    await cameraRests(page);
    await page.evaluate(() => window.planner.viewport.camera.zoom(0.5));
    await begin(page, 'annulus_scale');
    await page.locator('#f-factor').fill('120');
    await page.keyboard.press('Tab');
    await answered(page, 300);
    await cameraRests(page);
    assert.ok((await outside()) > 0 && (await distance()) < near);
    await page.getByRole('button', { name: 'Discard' }).click();
    await page.keyboard.press('1');
    await cameraRests(page);
  });

  it('shows_the_valve_before_at_a_press', async () => {
    await begin(page, 'ring');
    await page.locator('#f-size').fill('30');
    await page.keyboard.press('Tab');
    await answered(page);
    const now = await shown();
    await page.getByRole('button', { name: 'Before' }).click();
    assert.deepEqual(await shown(), await positions('main'));
    assert.match(await page.getByTestId('verdict').innerText(), /before/);
    await page.getByRole('button', { name: 'Preview' }).click();
    assert.deepEqual(await shown(), now);
    await apply(page);
    await page.locator('canvas').first().focus();
    await page.keyboard.press('w');
    assert.deepEqual(await shown(), await positions('first'));
    // whatever happens to the present valve shows it again
    await begin(page, 'clip');
    assert.deepEqual(await shown(), await positions('preview'));
    await page.keyboard.press('Escape');
    await undo(page);
  });

  it('keeps_the_valve_before_in_sight_when_a_preview_comes_late', async () => {
    await begin(page, 'annulus_scale');
    await answered(page);
    const hold = (on) => page.evaluate((value) => window.hold(value), on);
    const held = () => page.evaluate(() => window.heldAnswers());
    const past = () => page.evaluate(() => window.planner.state.inPast.value);
    await hold(true);
    await page.locator('#f-factor').fill('97');
    await page.keyboard.press('Enter');
    // the shape, the leak and all figures of the newer form
    while ((await held()) < 3) await page.waitForTimeout(20);
    await page.getByRole('button', { name: 'Before', exact: true }).click();
    await hold(false);
    await answered(page, 300);
    assert.ok(await past(), 'the late preview took the valve before away');
    assert.deepEqual(await shown(), await positions('main'));
    await page.getByRole('button', { name: 'Preview' }).click();
    assert.deepEqual(await shown(), await positions('preview'));
    // a newer form shows its preview
    await page.getByRole('button', { name: 'Before', exact: true }).click();
    await page.locator('#f-factor').fill('96');
    await page.keyboard.press('Enter');
    assert.ok(!(await past()));
    await answered(page);
    // with a form that is left, “before” would be another valve
    await page.getByRole('button', { name: 'Before', exact: true }).click();
    await page.keyboard.press('Escape');
    await page.keyboard.press('Escape');
    assert.ok(!(await past()));
  });

  it('covers_no_leaflet_by_a_notice', async () => {
    // the longest of those that come by themselves, from the atrium and in a narrow window as well
    await page.keyboard.press('1');
    await cameraRests(page);
    for (const [width, height] of [
      [1280, 720],
      [1024, 700],
    ]) {
      await page.setViewportSize({ width, height });
      await page.waitForTimeout(200);
      await page.evaluate(() => {
        const text = 'The plan “Valve 3: dilated, and a short chord” was put aside; it reaches all goals.';
        window.planner.state.notice.value = {
          kind: 'info',
          text,
          action: { text: 'Return to it', run() {} },
        };
      });
      const notice = await page.getByTestId('notice').boundingBox();
      const covered = await page.evaluate(({ x, y, width: w, height: h }) => {
        const { state, viewport } = window.planner;
        const { positions } = state.picture.value;
        const { triangles } = state.topologyOf(state.picture.value);
        const box = viewport.renderer.canvas.getBoundingClientRect();
        return [...new Set(triangles)].filter((node) => {
          const place = [...positions.slice(3 * node, 3 * node + 3), viewport.width, viewport.height];
          const [px, py] = viewport.camera.project(...place);
          const [left, top] = [box.left + px - x, box.top + py - y];
          return left > 0 && left < w && top > 0 && top < h;
        }).length;
      }, notice);
      assert.equal(covered, 0, `${width} x ${height}`);
      await page.locator('.notice').getByRole('button', { name: 'Close' }).click();
    }
    await page.setViewportSize({ width: 1280, height: 720 });
  });

  it('prints_the_report', async () => {
    await openPanel(page, 'Plan');
    await page.getByRole('button', { name: 'Report' }).click();
    await page.getByTestId('report').getByText('Before').first().waitFor();
    const pdf = await page.pdf({ format: 'A4' });
    // one page with four pictures; an empty one has 1 kB
    assert.ok(pdf.length > 50_000, `${pdf.length} bytes`);
    assert.equal(pdf.toString('latin1').match(/\/Type \/Page\b/g).length, 1);
    // on the screen as well, in a narrow window too
    const size = page.viewportSize();
    await page.setViewportSize({ width: 1024, height: 700 });
    const shown = await page.getByTestId('report').boundingBox();
    await page.setViewportSize(size);
    assert.ok(shown?.width > 500, `the report is ${shown?.width} pixels wide`);
    await page.keyboard.press('Escape');
  });

  it('takes_a_file_that_is_dropped_beside_the_picture', async () => {
    const taken = await page.evaluate(() => {
      const transfer = new DataTransfer();
      transfer.items.add(new File(['nothing'], 'words.txt'));
      const panel = document.querySelector('.panel');
      const send = (type) => {
        const event = new DragEvent(type, { dataTransfer: transfer, bubbles: true, cancelable: true });
        panel.dispatchEvent(event);
        return event.defaultPrevented;
      };
      return send('dragover') && send('drop');
    });
    assert.ok(taken, 'the browser would leave the page for the file');
    await page.getByText('words.txt is not a file this page can open').waitFor();
    await page.locator('.notice').getByRole('button', { name: 'Close' }).click();
  });

  it('shows_a_surface_from_the_atrium', async () => {
    await page.getByRole('button', { name: 'Healthy valve' }).click();
    await answered(page, 200);
    const path = temporaryFile('turned.obj', await openLeaflets(page, [2, 0, 1]));
    const valve = await page.evaluate(() => window.planner.state.main.value.figures.frame);
    await open(page, path);
    await page.getByRole('button', { name: 'Leave' }).waitFor();
    const found = await page.evaluate(() => window.planner.viewport.frameOf());
    const along = (row) => {
      const [x, y, z] = valve.slice(3 * row, 3 * row + 3);
      const turned = [z, x, y];
      return turned.reduce((sum, v, c) => sum + v * found[3 * row + c], 0);
    };
    // the annulus is a saddle, of which the library takes another plane: a few degrees
    assert.ok(along(3) > 0.98, `into the atrium: ${along(3)}`);
    // front and back cannot be told apart before a click
    assert.ok(Math.abs(along(1)) > 0.98, `front to back: ${along(1)}`);
    await page.getByRole('button', { name: 'Leave' }).click();
  });
});

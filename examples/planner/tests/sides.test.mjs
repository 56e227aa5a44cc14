// Left and right: whatever slides along the line of closure goes the same way as the valve in the surgeon's view, and the ends of
// its slider are named. A section cuts away the parts before its plane, and the bar beside the keys of the colours has a true length.
import assert from 'node:assert/strict';
import { describe, it } from 'node:test';
import { closed, sharePlanner } from './fixtures/browser.mjs';
import { answered, begin, cameraRests, openPanel } from './fixtures/person.mjs';

/** Pixels of the surgeon's view by which a part has to move: less would not be seen. */
const seen = 8;

describe('planner sides', () => {
  let page;
  sharePlanner((opened) => ({ page } = opened));
  const surgeonsView = async () => {
    await page.keyboard.press('1');
    await cameraRests(page);
  };
  /** Presses a slider at a share of its width from the left. */
  const pressAt = async (slider, share) => {
    await slider.scrollIntoViewIfNeeded();
    const { x, y, width, height } = await slider.boundingBox();
    await page.mouse.click(x + share * width, y + height / 2);
    await answered(page, 300);
  };
  /** The words at the ends of a slider. */
  const endsOf = async (slider) =>
    (await slider.locator('xpath=..').locator('.ends').innerText()).replace(/\s+/g, ' ');
  const label = async (text) => {
    await page.waitForTimeout(250);
    const { x } = await page.locator('.label-handle', { hasText: text }).boundingBox();
    return x;
  };
  /** Pixels from left to right of a place of the preview. */
  const across = (wanted) =>
    page.evaluate((part) => {
      const { state, viewport } = window.planner;
      const { picture } = state.preview.value;
      const topology = state.topologyOf(picture);
      const node =
        part === 'added chord'
          ? topology.chordNodes[2 * topology.chords.findIndex(({ id }) => id === state.added.value.id) + 1]
          : topology.headNodes[0];
      const place = picture.positions.slice(3 * node, 3 * node + 3);
      return viewport.camera.project(...place, viewport.width, viewport.height)[0];
    }, wanted);
  /** Presses the left and then the right part of a slider; the part of the picture has to follow. */
  const follows = async (name, slider, place) => {
    assert.equal(await endsOf(slider), 'anterolateral posteromedial', name);
    await pressAt(slider, 0.25);
    const left = await place();
    await pressAt(slider, 0.75);
    const right = await place();
    assert.ok(right > left + seen, `${name}: from ${left} to ${right}`);
  };

  it('of_the_section_are_those_of_the_surgeons_view', async () => {
    await openPanel(page, 'Valve');
    await page.locator('summary', { hasText: 'Section through the valve' }).click();
    await surgeonsView();
    await page.keyboard.press('x');
    const slider = page.locator('.slider', { hasText: 'Plane through' }).locator('input');
    await follows('section', slider, () => label('Cut plane'));
    assert.match(await slider.getAttribute('aria-valuetext'), /towards the posteromedial commissure/);
    await page.getByRole('button', { name: 'To the middle' }).click();
    // in the view along the axis the plane follows a drag as it follows its slider
    await page.keyboard.press('4');
    await cameraRests(page);
    const { x, y, height } = await page.locator('.label-handle', { hasText: 'Cut plane' }).boundingBox();
    await page.mouse.move(x - 24, y + height / 2);
    await page.mouse.down();
    await page.mouse.move(x + 26, y + height / 2, { steps: 5 });
    await page.mouse.up();
    assert.match(await slider.getAttribute('aria-valuetext'), /towards the posteromedial commissure/);
    await page.getByRole('button', { name: 'To the middle' }).click();
    await page.keyboard.press('x');
  });

  it('of_a_clip_and_of_an_artificial_chord_are_those_of_the_surgeons_view', async () => {
    await begin(page, 'clip');
    await surgeonsView();
    await follows('clip', page.locator('input[type=range][aria-label^="Position"]'), () => label('Clip'));
    await page.keyboard.press('Escape');
    await page.keyboard.press('Escape');
    await begin(page, 'neochord');
    await page.locator('#f-site').selectOption({ label: 'P2' });
    await page.locator('#f-head').selectOption({ index: 1 });
    await closed(page);
    await surgeonsView();
    const along = page.locator('.slider', { hasText: 'Along the scallop' }).locator('input');
    await follows('artificial chord', along, () => across('added chord'));
    await page.keyboard.press('Escape');
    await page.keyboard.press('Escape');
  });

  /** Opacity of devices that leaflets hide: of nothing else that is drawn over all. */
  const seenThrough = 0.45;

  it('of_a_clip_are_told_by_one_body_that_its_handles_are_on', async () => {
    await begin(page, 'clip');
    await surgeonsView();
    for (const fields of [{}, { position: 0.4, angle: -20 }, { position: -0.8, angle: 30 }]) {
      await page.evaluate((given) => window.planner.edit('clip', given), fields);
      await answered(page, 300);
      await page.waitForTimeout(250);
      const { away, drawnTwice } = await page.evaluate(
        ([opacity, degrees]) => {
          const { viewport, state } = window.planner;
          const { meshes } = viewport.scene();
          const body = meshes.find((mesh) => mesh.overlay && mesh.opacity === opacity);
          const marks = meshes.at(-1);
          // the ends of the arms lie at different depths; the bar and the beginnings of the arms are symmetric about the middle
          const { frame } = state.shown.value.figures;
          const turn = (degrees * Math.PI) / 180;
          const arm = [0, 1, 2].map((c) => Math.cos(turn) * frame[3 + c] + Math.sin(turn) * frame[6 + c]);
          const places = Array.from({ length: body.positions.length / 3 }, (_, k) => [
            ...body.positions.slice(3 * k, 3 * k + 3),
          ]);
          const mean = (rows) =>
            [0, 1, 2].map((c) => rows.reduce((sum, row) => sum + row[c], 0) / rows.length);
          const along = (place, from) => place.reduce((sum, v, c) => sum + (v - from[c]) * arm[c], 0);
          const all = mean(places);
          const middle = mean(places.filter((place) => Math.abs(along(place, all)) < 2.5));
          const [x, y] = viewport.camera.project(...middle, viewport.width, viewport.height);
          const label = [...document.querySelectorAll('.label-handle')].find((one) =>
            one.textContent.startsWith('Clip'),
          );
          const [px, py] = label.style.transform.match(/-?[\d.]+/g).map(Number);
          const colour = [...body.front.slice(0, 3)].join();
          const drawnTwice = Array.from({ length: marks.front.length / 3 }).some(
            (_, k) => [...marks.front.slice(3 * k, 3 * k + 3)].join() === colour,
          );
          return { away: Math.hypot(x - px, y - py), drawnTwice };
        },
        [seenThrough, fields.angle ?? 0],
      );
      // places of labels are written to a tenth of a pixel
      assert.ok(away < 0.2, `${JSON.stringify(fields)}: the ball is ${away} pixels from the clip`);
      assert.ok(!drawnTwice, `${JSON.stringify(fields)}: the handles have a bar of their own`);
    }
    await page.keyboard.press('Escape');
    await page.keyboard.press('Escape');
  });

  it('of_a_section_end_at_its_plane_for_clips_too', async () => {
    const { seen, capped, ends } = await page.evaluate(async () => {
      const { state, viewport, edit } = window.planner;
      edit('clip', { position: 0 });
      await new Promise((done) => {
        const wait = () =>
          state.preview.value?.figures.known === 'all' && !state.pending.value
            ? done()
            : requestAnimationFrame(wait);
        wait();
      });
      viewport.go('section', true);
      viewport.draw(false);
      const body = viewport.scene().meshes.find((mesh) => mesh.overlay && mesh.opacity === 0.45);
      const blue = [...body.front.slice(0, 3)];
      state.sectionOn.value = true;
      const { normal } = viewport.plane();
      const away = Array.from({ length: body.positions.length / 3 }, (_, k) =>
        normal.reduce((sum, n, c) => sum + n * body.positions[3 * k + c], 0),
      );
      const f = viewport.frameOf();
      const origin = normal.reduce((sum, n, c) => sum + n * f[c], 0);
      const [low, high] = [Math.min(...away) - origin, Math.max(...away) - origin];
      // faces of a cut are darker than the surface
      const darker = blue.map((v) => 0.75 * v);
      const [seen, capped] = [{}, {}];
      for (const [name, offset] of [
        ['before', low - 1],
        ['through', (low + high) / 2],
        ['behind', high + 1],
      ]) {
        state.sectionAt.value = offset;
        const { meshes } = viewport.scene();
        seen[name] = meshes.filter((mesh) => mesh.overlay && mesh.opacity === 0.45).length;
        const faces = meshes.filter((mesh) => mesh.flat && !mesh.overlay);
        capped[name] = faces.some(({ front }) =>
          Array.from({ length: front.length / 3 }).some((_, k) =>
            darker.every((v, c) => Math.abs(front[3 * k + c] - v) < 1e-4),
          ),
        );
      }
      const ends = viewport.scene().meshes.filter(({ positions }) => positions === body.positions);
      [state.sectionOn.value, state.sectionAt.value] = [false, 0];
      return { seen, capped, ends: ends.map(({ cut }) => cut) };
    });
    assert.deepEqual(ends, [true]);
    assert.deepEqual(seen, { before: 0, through: 0, behind: 0 });
    assert.deepEqual(capped, { before: false, through: true, behind: false });
    await page.keyboard.press('Escape');
    await page.keyboard.press('Escape');
  });

  it('of_a_papillary_head_are_those_of_the_surgeons_view', async () => {
    await begin(page, 'head_move');
    await page.locator('#f-head').selectOption({ index: 1 });
    await surgeonsView();
    const slider = page.locator('fieldset .slider').nth(1).locator('input');
    await follows('head', slider, () => across('head'));
    await page.locator('.slider', { hasText: 'Towards the posteromedial side' }).waitFor();
    // along the axes of the file there are no anatomical sides
    await page.locator('.form summary', { hasText: 'More' }).click();
    await page.locator('#f-frame').selectOption('0');
    await page.locator('.slider', { hasText: 'y of the file' }).waitFor();
    await page.keyboard.press('Escape');
    await page.keyboard.press('Escape');
  });

  it('shows_a_length_that_is_true_at_the_middle_of_the_picture', async () => {
    for (const zoom of [0, -600, 900]) {
      await page.mouse.move(500, 400);
      if (zoom) await page.mouse.wheel(0, zoom);
      await cameraRests(page);
      const { mm, bar, drawn } = await page.evaluate(() => {
        const { camera, width, height } = window.planner.viewport;
        const element = document.querySelector('[data-testid=length]');
        const mm = parseFloat(element.textContent);
        const { target, orientation } = camera;
        const across = target.clone().set(mm, 0, 0).applyQuaternion(orientation).add(target);
        const [a, b] = [target, across].map(({ x, y, z }) => camera.project(x, y, z, width, height)[0]);
        return { mm, bar: element.getBoundingClientRect().width, drawn: b - a };
      });
      // the width of an element is written with a digit behind the point
      assert.ok(Math.abs(bar - drawn) < 0.2 && bar > 39 && bar <= 100, `${mm} mm: ${bar}, drawn ${drawn}`);
    }
    await page.keyboard.press('1');
    await cameraRests(page);
  });

  it('cuts_away_the_papillary_muscle_before_the_plane_of_a_section', async () => {
    const names = () =>
      page.evaluate(() =>
        [...document.querySelectorAll('.label-head')].filter((e) => !e.hidden).map((e) => e.textContent),
      );
    await page.keyboard.press('4');
    await cameraRests(page);
    await page.waitForTimeout(250);
    assert.deepEqual(await names(), ['PM']);
    await page.keyboard.press('x');
    await page.waitForTimeout(250);
    assert.ok((await names()).includes('AL'));
    await page.keyboard.press('1');
    await cameraRests(page);
  });
});

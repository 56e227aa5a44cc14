// Left and right: whatever slides along the line of closure goes the same way as the valve in the surgeon's view, and the ends of
// its slider are named.
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
  /** What the ends of a slider say. */
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
    await page.keyboard.press('x');
    await surgeonsView();
    const slider = page.locator('.slider', { hasText: 'Plane through' }).locator('input');
    await follows('section', slider, () => label('Section plane'));
    assert.match(await slider.getAttribute('aria-valuetext'), /towards the posteromedial commissure/);
    await page.getByRole('button', { name: 'To the middle' }).click();
    // in the view along the axis the plane follows a drag as it follows its slider
    await page.keyboard.press('4');
    await cameraRests(page);
    const { x, y, height } = await page.locator('.label-handle', { hasText: 'Section plane' }).boundingBox();
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
});
